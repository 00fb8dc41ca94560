// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/partition/node_order.h"

#include <type_traits>

#include "mesher/partition/metis.h"

namespace flexneck::mesher {
namespace {

static_assert(std::is_same_v<idx_t, std::int32_t>, "METIS must have 32-bit indices");

/// @param offsets, columns  without loops; METIS takes them as not const but leaves them alone
std::vector<std::int32_t> order_without_loops(idx_t vertices, idx_t* offsets, idx_t* columns) {
  MetisOptions options = metis_options();
  std::vector<std::int32_t> order(static_cast<std::size_t>(vertices));
  std::vector<std::int32_t> place(order.size());
  require_metis(METIS_NodeND(&vertices, offsets, columns, nullptr, options.data(), order.data(),
                             place.data()),
                "ordering by nested dissection");
  return order;
}

}  // namespace

std::vector<std::int32_t> nested_dissection(std::span<const std::int32_t> offsets,
                                            std::span<const std::int32_t> columns) {
  std::vector<idx_t> own_offsets = {0};
  std::vector<idx_t> own_columns;
  own_offsets.reserve(offsets.size());
  own_columns.reserve(columns.size());
  for (std::size_t v = 0; v + 1 < offsets.size(); ++v) {
    for (std::int32_t k = offsets[v]; k < offsets[v + 1]; ++k) {
      const std::int32_t column = columns[static_cast<std::size_t>(k)];
      if (column != static_cast<std::int32_t>(v)) own_columns.push_back(column);
    }
    own_offsets.push_back(static_cast<idx_t>(own_columns.size()));
  }
  return order_without_loops(static_cast<idx_t>(own_offsets.size()) - 1, own_offsets.data(),
                             own_columns.data());
}

std::vector<std::int32_t> nested_dissection(const Mesh& mesh) {
  std::vector<idx_t> offsets = {0};
  std::vector<idx_t> nodes;
  for (const ElementBlock& block : mesh.blocks) {
    const auto width = static_cast<idx_t>(nodes_per_element(block.kind));
    for (std::size_t e = 0; e < block.size(); ++e) offsets.push_back(offsets.back() + width);
    nodes.insert(nodes.end(), block.nodes.begin(), block.nodes.end());
  }
  auto element_count = static_cast<idx_t>(offsets.size()) - 1;
  auto node_count = static_cast<idx_t>(mesh.nodes.size());
  idx_t from_zero = 0;
  idx_t* graph_offsets = nullptr;
  idx_t* graph_columns = nullptr;
  require_metis(METIS_MeshToNodal(&element_count, &node_count, offsets.data(), nodes.data(),
                                  &from_zero, &graph_offsets, &graph_columns),
                "finding the neighbours of the nodes");
  const MetisArray own_offsets(graph_offsets);
  const MetisArray own_columns(graph_columns);
  return order_without_loops(node_count, own_offsets.get(), own_columns.get());
}

}  // namespace flexneck::mesher
