// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "fe_modal/solve/assembled_system.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Crude estimate of a body's lowest elastic eigenvalue, 1/s^2: (c / L)^2 of the slowest material.
double eigenvalue_scale(const mesher::Mesh& mesh);

/// The shift of a body's stiffness: none of a fixed one, which has a definite stiffness; below zero
/// of one that keeps rigid motions.
inline double shift_of(const Model& model) {
  return model.rigid().count() == 0 ? 0 : -eigenvalue_scale(model.mesh());
}

/// Whether x^T K x of each column is lost in the rounding of the entries that it is summed from,
/// eps sum K_ii x_i^2: of motions without strain it is 0.1 of that, of a hinge of 5 nodes that are
/// off its axis by 1e-6 of its length 100 times as much. Collective.
Eigen::Array<bool, Eigen::Dynamic, 1> are_strainless(const ModalSystem& system,
                                                     const Eigen::MatrixXd& motions);

/// Which parts move without strain, and how, e.g. "part 'pin' turns freely about z through (0, 0,
/// 0.1) m". Of a body that keeps rigid motions these do not count: the heaviest part stands still.
/// @param is_fixed whether supports leave the body no rigid motion
/// @return nothing if every such motion is too large for parts as rigid bodies: then it bends
/// @throws ComputationError if the motions cannot be computed.
std::optional<std::string> describe_mechanism(const AssembledSystem& system, bool is_fixed);

}  // namespace flexneck::fe_modal
