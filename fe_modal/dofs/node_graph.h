// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "fe_modal/dofs/dof_map.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Graph of nodes that share an element, in compressed rows: the sparsity of every nodal matrix.
class NodeGraph {
 public:
  /// Graph of all nodes of the mesh.
  explicit NodeGraph(const mesher::Mesh& mesh);
  /// Graph of the blocks of degrees of freedom that elements, point masses and springs join.
  NodeGraph(const mesher::Mesh& mesh, const DofMap& dof_map);

  /// Takes a graph that was found elsewhere.
  NodeGraph(std::vector<std::int32_t> offsets, std::vector<std::int32_t> columns)
      : offsets_(std::move(offsets)), columns_(std::move(columns)) {}

  std::int32_t node_count() const { return static_cast<std::int32_t>(offsets_.size()) - 1; }
  /// Nodes that share an element with this one, including itself, ascending.
  std::span<const std::int32_t> neighbours(std::int32_t node) const {
    const auto row = static_cast<std::size_t>(node);
    const auto begin = static_cast<std::size_t>(offsets_[row]);
    return std::span(columns_).subspan(begin, static_cast<std::size_t>(offsets_[row + 1]) - begin);
  }

  const std::vector<std::int32_t>& offsets() const { return offsets_; }  ///< (n + 1)
  const std::vector<std::int32_t>& columns() const { return columns_; }

 private:
  std::vector<std::int32_t> offsets_;
  std::vector<std::int32_t> columns_;
};

}  // namespace flexneck::fe_modal
