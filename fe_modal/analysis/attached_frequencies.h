// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/reduction/reduction.h"
#include "fe_modal/solve/assembled_system.h"
#include "fe_modal/system/modal_options.h"
#include "fe_modal/system/rigid_average.h"

namespace flexneck::fe_modal {

Eigen::VectorXd frequencies_Hz(const Eigen::VectorXd& eigenvalues);

/// Index of an interface in options.interfaces; it is known to be there.
std::size_t interface_index(const ModalOptions& options, const std::string& name);

/// An assembled and factorised body.
struct SolvedBody {
  const AssembledSystem& system;
  const LinearSolver& inverse;
  const std::vector<RigidAverage>& averages;  ///< one for each of the options' interfaces
  const std::vector<InterfaceLoads>& loads;   ///< one for each of the options' interfaces
};

/// Lowest frequencies with each of the options' bodies attached.
/// @param shapes takes the modes with each body, normalised to unit mass with it, if it is not null
std::vector<AttachedFrequencies> attach_bodies(const SolvedBody& solved,
                                               std::vector<std::vector<Eigen::Matrix3Xd>>* shapes);

}  // namespace flexneck::fe_modal
