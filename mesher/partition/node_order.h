// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// An order of elimination that keeps the fill of a Cholesky factor small: multilevel nested
/// dissection by METIS (Karypis and Kumar, SIAM J. Sci. Comput. 20 (1998) 359). Entry k is the
/// vertex that is eliminated k-th. Equal input gives the same order.
/// @param offsets  (n + 1) of a symmetric graph in compressed rows
/// @param columns  neighbours; a vertex may be listed among its own
/// @throws ComputationError if METIS fails.
std::vector<std::int32_t> nested_dissection(std::span<const std::int32_t> offsets,
                                            std::span<const std::int32_t> columns);

/// The same for the nodes of a mesh: those of one element are neighbours.
std::vector<std::int32_t> nested_dissection(const Mesh& mesh);

}  // namespace flexneck::mesher
