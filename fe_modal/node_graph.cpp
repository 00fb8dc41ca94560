// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/node_graph.h"

#include <algorithm>
#include <utility>

namespace flexneck::fe_modal {
namespace {

/// Elements of each node in compressed rows.
struct ElementsOfNodes {
  std::vector<std::span<const std::int32_t>> elements;  ///< nodes of each element
  std::vector<std::size_t> offsets;
  std::vector<std::size_t> of_node;
};

ElementsOfNodes invert(const mesher::Mesh& mesh) {
  ElementsOfNodes result;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e) {
      result.elements.push_back(std::span(block.nodes).subspan(e * width, width));
    }
  }
  result.offsets.assign(mesh.nodes.size() + 1, 0);
  for (const auto nodes : result.elements) {
    for (const std::int32_t node : nodes) ++result.offsets[static_cast<std::size_t>(node) + 1];
  }
  for (std::size_t k = 1; k < result.offsets.size(); ++k)
    result.offsets[k] += result.offsets[k - 1];
  result.of_node.resize(result.offsets.back());
  std::vector<std::size_t> next(result.offsets.begin(), result.offsets.end() - 1);
  for (std::size_t e = 0; e < result.elements.size(); ++e) {
    for (const std::int32_t node : result.elements[e]) {
      result.of_node[next[static_cast<std::size_t>(node)]++] = e;
    }
  }
  return result;
}

}  // namespace

NodeGraph::NodeGraph(const mesher::Mesh& mesh) {
  const ElementsOfNodes map = invert(mesh);
  std::vector<std::size_t> seen_by(mesh.nodes.size(), mesh.nodes.size());
  offsets_.push_back(0);
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    const auto row = static_cast<std::ptrdiff_t>(columns_.size());
    for (std::size_t k = map.offsets[node]; k < map.offsets[node + 1]; ++k) {
      for (const std::int32_t other : map.elements[map.of_node[k]]) {
        if (std::exchange(seen_by[static_cast<std::size_t>(other)], node) != node) {
          columns_.push_back(other);
        }
      }
    }
    std::sort(columns_.begin() + row, columns_.end());
    offsets_.push_back(static_cast<std::int32_t>(columns_.size()));
  }
}

std::span<const std::int32_t> NodeGraph::neighbours(std::int32_t node) const {
  const auto row = static_cast<std::size_t>(node);
  const auto begin = static_cast<std::size_t>(offsets_[row]);
  return std::span(columns_).subspan(begin, static_cast<std::size_t>(offsets_[row + 1]) - begin);
}

}  // namespace flexneck::fe_modal
