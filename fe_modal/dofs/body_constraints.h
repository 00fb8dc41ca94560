// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "fe_modal/dofs/affine_constraints.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Constraints of tied slits and fixed nodes. The lowest of nodes tied together is independent.
AffineConstraints tie_and_fix(std::size_t node_count, std::span<const std::int32_t> fixed,
                              std::span<const mesher::Slit> slits);

/// Constraints of tied slits, fixed nodes and all connections of the nodes, on the sites of the
/// connections: ties, couplings and equations first, whose dependent degrees of freedom are given,
/// then supports. A motion of a reference point that no connection resists, such as the rotation
/// about a line of coupled nodes, is zero.
/// @throws InputError as AffineConstraints, for nodes on the axis of a support's cylindrical axes,
/// and for a reference point with a mass and an unconstrained motion.
AffineConstraints constraints_of(const mesher::Mesh& mesh, std::span<const std::int32_t> fixed,
                                 const mesher::Connections& connections);

}  // namespace flexneck::fe_modal
