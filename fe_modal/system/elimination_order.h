// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "fe_modal/dofs/dof_map.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// An order of elimination of all nodes as one of the blocks of degrees of freedom; of tied nodes
/// the first one counts. Empty: stays so.
std::vector<std::int32_t> order_of_blocks(const std::vector<std::int32_t>& node_order,
                                          const DofMap& dof_map);

/// The order in which the blocks of a body are eliminated: that of its nodes where one is known,
/// else nested dissection by METIS. Of nodes, not of rows: a third as many.
std::vector<std::int32_t> elimination_order_of(const mesher::Mesh& mesh, const DofMap& dof_map,
                                               const std::vector<std::int32_t>& node_order);

}  // namespace flexneck::fe_modal
