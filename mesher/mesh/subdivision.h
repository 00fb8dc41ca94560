// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "mesher/mesh/element_kind.h"
#include "mesher/mesh/refined_nodes.h"

namespace flexneck::mesher {

/// Pieces of one kind: row-major (pieces, nodes per element) local positions, or nodes of a mesh.
template <typename Index>
using ByKind = std::map<ElementKind, std::vector<Index>>;

/// How elements or faces of a kind are cut, in eight or four: along the planes that halve the
/// reference element. Pyramids become pyramids and tetrahedra.
struct Subdivision {
  explicit Subdivision(ElementKind whole);

  ElementKind kind;
  /// That the pieces have nodes at: shape functions, not zero there, of the local nodes.
  std::vector<std::vector<NodeWeight>> positions;
  ByKind<std::size_t> pieces;  ///< by positions
};

}  // namespace flexneck::mesher
