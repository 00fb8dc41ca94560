// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "fe_modal/dofs/dof_map.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Converts an order of elimination of all nodes to one of the blocks of degrees of freedom; the
/// first of tied nodes counts. An empty order stays empty.
std::vector<std::int32_t> order_of_blocks(const std::vector<std::int32_t>& node_order,
                                          const DofMap& dof_map);

/// Order in which the blocks of a body are eliminated: that of its nodes if it is known, else
/// nested dissection by METIS, applied to nodes instead of rows, a third as many.
std::vector<std::int32_t> elimination_order_of(const mesher::Mesh& mesh, const DofMap& dof_map,
                                               const std::vector<std::int32_t>& node_order);

}  // namespace flexneck::fe_modal
