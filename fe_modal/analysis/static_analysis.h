// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/static_solution.h"
#include "fe_modal/system/loads.h"
#include "fe_modal/system/model.h"
#include "geometry/foundation/progress.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Solution of K u = f under some loads, small displacements.
struct StaticStep {
  Eigen::Matrix3Xd displacements_m;  ///< (3, n), including those of the supports
  Eigen::Matrix3Xd applied_N;        ///< (3, n), nodal forces of the loads
  /// Forces of springs and weights at reference points on the free dofs.
  Eigen::VectorXd point_forces;
  std::string solver;  ///< method of solution
};

/// Solves the linear static step alone.
/// @param loads at least one
/// @throws InputError for a body without supports, or that is a mechanism; and as nodal_forces()
/// and support_displacements() do.
/// @throws ComputationError if the factorisation or the iteration fails.
StaticStep static_step(const Model& model, const std::vector<Load>& loads,
                       const Progress& progress);

/// Nodal forces of the loads alone, (3, n) in N, for other programs.
Eigen::Matrix3Xd consistent_forces(const mesher::Mesh& mesh, const ModalOptions& options,
                                   const std::vector<Load>& loads);

/// Solves the static step, with the reactions of the supports and all stresses.
/// @throws as static_step() and check_options() do, and ComputationError if the free nodes are not
/// in equilibrium.
StaticSolution analyse_static(const mesher::Mesh& mesh, const ModalOptions& options,
                              const std::vector<Load>& loads, const Progress& progress);

}  // namespace flexneck::fe_modal
