// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/node_graph.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "fe_modal/dofs/point_element.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Lists of different lengths in compressed rows.
struct Rows {
  std::vector<std::size_t> offsets = {0};
  std::vector<std::int32_t> entries;

  std::span<const std::int32_t> row(std::size_t k) const {
    return std::span(entries).subspan(offsets[k], offsets[k + 1] - offsets[k]);
  }
  std::size_t size() const { return offsets.size() - 1; }
};

/// Lists of the numbers that `emit_numbers(node, emit)` emits for the nodes of each element.
template <typename Numbering>
Rows nodes_of_elements(const mesher::Mesh& mesh, const Numbering& emit_numbers) {
  Rows result;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += width) {
      for (const std::int32_t node : std::span(block.nodes).subspan(first, width)) {
        emit_numbers(node, [&](std::int32_t number) { result.entries.push_back(number); });
      }
      result.offsets.push_back(result.entries.size());
    }
  }
  return result;
}

Rows transpose(const Rows& rows, std::size_t column_count) {
  Rows result;
  result.offsets.assign(column_count + 1, 0);
  for (const std::int32_t column : rows.entries) {
    ++result.offsets[static_cast<std::size_t>(column) + 1];
  }
  for (std::size_t k = 0; k < column_count; ++k) result.offsets[k + 1] += result.offsets[k];
  result.entries.resize(rows.entries.size());
  std::vector<std::size_t> next(result.offsets.begin(), result.offsets.end() - 1);
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (const std::int32_t column : rows.row(row)) {
      result.entries[next[static_cast<std::size_t>(column)]++] = static_cast<std::int32_t>(row);
    }
  }
  return result;
}

/// Makes the rows of the graph from the nodes of the elements.
void connect(const Rows& elements, std::size_t node_count, std::vector<std::int32_t>& offsets,
             std::vector<std::int32_t>& columns) {
  const Rows elements_of_nodes = transpose(elements, node_count);
  std::vector<std::size_t> seen_by(node_count, node_count);
  offsets.push_back(0);
  for (std::size_t node = 0; node < node_count; ++node) {
    const auto row = static_cast<std::ptrdiff_t>(columns.size());
    for (const std::int32_t element : elements_of_nodes.row(node)) {
      for (const std::int32_t other : elements.row(static_cast<std::size_t>(element))) {
        if (std::exchange(seen_by[static_cast<std::size_t>(other)], node) != node) {
          columns.push_back(other);
        }
      }
    }
    if (columns.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
      throw InputError(
          "the mesh has more pairs of neighbouring nodes than 32-bit integers can count; use a "
          "coarser mesh");
    }
    std::sort(columns.begin() + row, columns.end());
    offsets.push_back(static_cast<std::int32_t>(columns.size()));
  }
  columns.shrink_to_fit();
}

}  // namespace

NodeGraph::NodeGraph(const mesher::Mesh& mesh) {
  const auto itself = [](std::int32_t node, const auto& emit) { emit(node); };
  connect(nodes_of_elements(mesh, itself), mesh.nodes.size(), offsets_, columns_);
}

NodeGraph::NodeGraph(const mesher::Mesh& mesh, const DofMap& dof_map) {
  const auto free = [&](std::int32_t site, const auto& emit) {
    dof_map.for_each_number(site, emit);
  };
  Rows elements = nodes_of_elements(mesh, free);
  for (const PointElement& point : point_elements_of(mesh.connections, mesh.nodes.size())) {
    for (const std::int32_t site : point.sites) {
      free(site, [&](std::int32_t block) { elements.entries.push_back(block); });
    }
    elements.offsets.push_back(elements.entries.size());
  }
  // The block of a reference point without connections keeps its diagonal.
  for (auto site = static_cast<std::int32_t>(dof_map.node_count()); site < dof_map.site_count();
       ++site) {
    free(site, [&](std::int32_t block) { elements.entries.push_back(block); });
    elements.offsets.push_back(elements.entries.size());
  }
  connect(elements, static_cast<std::size_t>(dof_map.free_count()), offsets_, columns_);
}

}  // namespace flexneck::fe_modal
