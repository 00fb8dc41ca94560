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

/// Eigenvalues below this share of the scale belong to motions without strain.
inline constexpr double kStrainless = 1e-6;
/// The same of a mesh: on springs a body may move as softly as they are.
double strainless_share(const mesher::Mesh& mesh);

/// Which parts move without strain, and how, e.g. "part 'pin' turns freely about z through (0, 0,
/// 0.1) m". Of a body that keeps rigid motions these do not count: the heaviest part stands still.
/// @param is_fixed whether supports leave the body no rigid motion
/// @return nothing if every such motion is too large for parts as rigid bodies: then it bends
/// @throws ComputationError if the motions cannot be computed.
std::optional<std::string> describe_mechanism(const AssembledSystem& system, bool is_fixed);

}  // namespace flexneck::fe_modal
