// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"
#include "fe_modal/system/modal_options.h"
#include "geometry/foundation/progress.h"
#include "geometry/foundation/step_times.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Fields on all nodes, (3, n) each, from which the derivatives of a body's results are computed
/// (sensitivity.h).
struct AnalysisFields {
  /// For each interface of the options: displacements under its unit loads, force (3) and moment
  /// (3), m/N and 1/N. Empty for a free body.
  std::vector<std::vector<Eigen::Matrix3Xd>> responses;
  /// For each attachment: modes of the body with it, normalised to unit mass with it.
  std::vector<std::vector<Eigen::Matrix3Xd>> attached_shapes;
  double next_Hz = 0;  ///< frequency above the last mode; infinite if it is not known
};

/// Computes normal modes by shift-invert, completes them to the requested basis and reduces the
/// body to it.
/// @param times takes the time of each step if it is not null
/// @param warn takes a line if the number of modes cuts a cluster of equal frequencies; may be
/// empty
/// @param fields takes fields of the same solution if it is not null, at the cost of a few more
/// solves
/// @throws InputError for a body that buckles under its prestress, unknown sets, parts or
/// interfaces, elements without the requested formulation, more modes than degrees of freedom, a
/// basis that the boundary does not allow, more than memory holds, or a body that is a mechanism:
/// the message names the parts that move without strain, and how.
/// @throws ComputationError if the factorisation or the eigensolver fails, or if a mode is missing.
ModalBody analyse_modes(const mesher::Mesh& mesh, const ModalOptions& options,
                        const Progress& progress, StepTimes* times = nullptr,
                        const Progress& warn = {}, AnalysisFields* fields = nullptr);

}  // namespace flexneck::fe_modal
