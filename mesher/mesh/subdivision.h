// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "mesher/mesh/element_kind.h"
#include "mesher/mesh/refined_nodes.h"

namespace flexneck::mesher {

/// Children by their kind: row-major (children, nodes per element) indices of nodes, local or of a
/// mesh.
template <typename Index>
using ByKind = std::map<ElementKind, std::vector<Index>>;

/// Division of the elements or faces of a kind into eight or four, along the planes that halve the
/// reference element. Pyramids become pyramids and tetrahedra.
struct Subdivision {
  explicit Subdivision(ElementKind whole);

  ElementKind kind;
  /// Positions of the children's nodes, each given by the parent's shape functions that are not
  /// zero there.
  std::vector<std::vector<NodeWeight>> positions;
  ByKind<std::size_t> pieces;  ///< their nodes as indices into `positions`
};

}  // namespace flexneck::mesher
