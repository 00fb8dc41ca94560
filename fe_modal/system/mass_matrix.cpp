// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/mass_matrix.h"

#include <algorithm>
#include <vector>

namespace flexneck::fe_modal {
namespace {

NodalMass restrict_to_free(const NodalMass& all_nodes, const NodeGraph& graph,
                           const DofMap& dof_map) {
  NodalMass result = zero_nodal_mass(graph);
  for (std::int32_t node = 0; node < dof_map.node_count(); ++node) {
    const std::int32_t row = dof_map.index(node);
    if (row < 0) continue;
    const auto columns = graph.neighbours(row);
    double* values = result.valuePtr() + result.outerIndexPtr()[row];
    auto place = columns.begin();
    for (NodalMass::InnerIterator entry(all_nodes, node); entry; ++entry) {
      const std::int32_t column = dof_map.index(static_cast<std::int32_t>(entry.col()));
      if (column < 0) continue;
      // Columns ascend, unless nodes are tied.
      if (place == columns.end() || column < *place) place = columns.begin();
      place = std::lower_bound(place, columns.end(), column);
      values[place - columns.begin()] += entry.value();
    }
  }
  return result;
}

}  // namespace

NodalMass zero_nodal_mass(const NodeGraph& graph) {
  const auto n = static_cast<Eigen::Index>(graph.node_count());
  const std::vector<double> zeros(graph.columns().size(), 0.0);
  return Eigen::Map<const NodalMass>(n, n, static_cast<Eigen::Index>(zeros.size()),
                                     graph.offsets().data(), graph.columns().data(), zeros.data());
}

MassMatrix::MassMatrix(const NodalMass& all_nodes, const NodeGraph& graph, const DofMap& dof_map)
    : nodal_(std::make_unique<const NodalMass>(restrict_to_free(all_nodes, graph, dof_map))),
      operator_(dof_map.dof_count(), [mass = nodal_.get()](const Eigen::MatrixXd& columns) {
        return block_product(*mass, columns);
      }) {}

}  // namespace flexneck::fe_modal
