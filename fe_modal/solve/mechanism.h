// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "fe_modal/solve/assembled_system.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Rough estimate of a body's lowest elastic eigenvalue, 1/s^2: (c / L)^2 of the slowest material.
double eigenvalue_scale(const mesher::Mesh& mesh);

/// Shift of a body's stiffness: zero for a fixed body, which has a definite stiffness; negative for
/// a body with rigid motions.
inline double shift_of(const Model& model) {
  return model.rigid().count() == 0 ? 0 : -eigenvalue_scale(model.mesh());
}

/// Returns for each column whether x^T K x is lost in the rounding of the entries of its sum, eps
/// sum K_ii x_i^2: for motions without strain it is 0.1 of that, for a hinge of 5 nodes that are
/// off its axis by 1e-6 of its length 100 times as much. Collective.
Eigen::Array<bool, Eigen::Dynamic, 1> are_strainless(const ModalSystem& system,
                                                     const Eigen::MatrixXd& motions);

/// Describes the parts that move without strain, and their motions, e.g. "part 'pin' turns freely
/// about z through (0, 0, 0.1) m". For a body with rigid motions these do not count: the motions
/// are relative to the heaviest part.
/// @param is_fixed true if supports leave the body no rigid motion
/// @return nothing if there is no such motion, or if a moving part deforms in one: then it bends
/// @throws ComputationError if the motions cannot be computed.
std::optional<std::string> describe_mechanism(const AssembledSystem& system, bool is_fixed);

}  // namespace flexneck::fe_modal
