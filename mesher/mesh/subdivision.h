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

/// Way in which elements or faces of a kind become finer.
enum class Finer {
  cut,   ///< eight or four, along the planes that halve the reference element; pyramids become
         ///< pyramids and tetrahedra
  raise  ///< the quadratic one of most nodes in place of a linear one; others stay
};

/// Children of the elements or faces of a kind in a finer mesh.
struct Subdivision {
  Subdivision(ElementKind whole, Finer how);

  ElementKind kind;
  /// Positions of the children's nodes, each given by the parent's shape functions that are not
  /// zero there.
  std::vector<std::vector<NodeWeight>> positions;
  ByKind<std::size_t> pieces;  ///< their nodes as indices into `positions`
};

}  // namespace flexneck::mesher
