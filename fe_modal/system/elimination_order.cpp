// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/elimination_order.h"

#include "fe_modal/dofs/node_graph.h"
#include "mesher/partition/node_order.h"

namespace flexneck::fe_modal {
std::vector<std::int32_t> order_of_blocks(const std::vector<std::int32_t>& node_order,
                                          const DofMap& dof_map) {
  std::vector<std::int32_t> order;
  std::vector<bool> has_come(static_cast<std::size_t>(dof_map.free_count()));
  for (const std::int32_t node : node_order) {
    const std::int32_t block = dof_map.index(node);
    if (block < 0 || has_come[static_cast<std::size_t>(block)]) continue;
    has_come[static_cast<std::size_t>(block)] = true;
    order.push_back(block);
  }
  // Blocks of rigid couplings come last: they couple all nodes of a face.
  for (std::size_t k = 0; !order.empty() && k < has_come.size(); ++k) {
    if (!has_come[k]) order.push_back(static_cast<std::int32_t>(k));
  }
  return order;
}

std::vector<std::int32_t> elimination_order_of(const mesher::Mesh& mesh, const DofMap& dof_map,
                                               const std::vector<std::int32_t>& node_order) {
  const std::vector<std::int32_t> known = order_of_blocks(node_order, dof_map);
  if (!known.empty()) return known;
  const NodeGraph graph(mesh, dof_map);
  return mesher::nested_dissection(graph.offsets(), graph.columns());
}

}  // namespace flexneck::fe_modal
