// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "fe_modal/dofs/dof_map.h"
#include "fe_modal/dofs/node_graph.h"
#include "fe_modal/system/modal_options.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// An order of elimination of all nodes as one of the blocks of degrees of freedom; of tied nodes
/// the first one counts. Empty: stays so.
std::vector<std::int32_t> order_of_blocks(const std::vector<std::int32_t>& node_order,
                                          const DofMap& dof_map);

/// Nested dissection, in a postorder of the elimination tree.
std::vector<std::int32_t> elimination_order_of(const NodeGraph& graph);

/// As dof_map_of(). A body that one process solves directly has its blocks numbered in the order of
/// elimination, that of the options or nested dissection, and in a postorder of its tree, so that
/// CHOLMOD takes the stiffness as it is; others, and bodies with constraints, in the order of the
/// sites.
DofMap numbered_dof_map_of(const mesher::Mesh& mesh, const ModalOptions& options);

}  // namespace flexneck::fe_modal
