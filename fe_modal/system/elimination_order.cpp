// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/elimination_order.h"

#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/dofs/node_graph.h"
#include "mesher/partition/node_order.h"

namespace flexneck::fe_modal {
namespace {

/// The same elimination with each branch of its tree by itself: what is joined to a supernode has
/// neighbouring numbers.
std::vector<std::int32_t> postordered(const NodeGraph& graph,
                                      const std::vector<std::int32_t>& order) {
  const cholmod_sparse pattern = cholmod_view(graph.offsets(), graph.columns(), {});
  const CholmodAnalysis analysis(pattern, CholmodOrder::given, order);
  const auto* const permutation = static_cast<const int*>(analysis.places().Perm);
  return {permutation, permutation + analysis.places().n};
}

}  // namespace

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
  // Rigid couplings last: they couple all of a face.
  for (std::size_t k = 0; !order.empty() && k < has_come.size(); ++k) {
    if (!has_come[k]) order.push_back(static_cast<std::int32_t>(k));
  }
  return order;
}

std::vector<std::int32_t> elimination_order_of(const NodeGraph& graph) {
  return postordered(graph, mesher::nested_dissection(graph.offsets(), graph.columns()));
}

DofMap numbered_dof_map_of(const mesher::Mesh& mesh, const ModalOptions& options) {
  DofMap dof_map = dof_map_of(mesh, options);
  if (options.solver == Solver::iterative || options.ranks.are_many() || dof_map.is_constrained())
    return dof_map;
  const NodeGraph graph(mesh, dof_map);
  const std::vector<std::int32_t> order = order_of_blocks(options.node_order, dof_map);
  dof_map.renumber(order.empty() ? elimination_order_of(graph) : postordered(graph, order));
  return dof_map;
}

}  // namespace flexneck::fe_modal
