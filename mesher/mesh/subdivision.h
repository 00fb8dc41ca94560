// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "mesher/mesh/element_kind.h"
#include "mesher/mesh/refined_nodes.h"

namespace flexneck::mesher {

/// Pieces by their kind: row-major (pieces, nodes per element) places of nodes, local or of a mesh.
template <typename Index>
using ByKind = std::map<ElementKind, std::vector<Index>>;

/// How elements or faces of a kind are cut, in eight or four: along the planes that halve the
/// reference element. Pyramids become pyramids and tetrahedra.
struct Subdivision {
  explicit Subdivision(ElementKind whole);

  ElementKind kind;
  /// Of the pieces' nodes, each by those local nodes of the whole whose shape functions are not
  /// zero there.
  std::vector<std::vector<NodeWeight>> positions;
  ByKind<std::size_t> pieces;  ///< their nodes as places in `positions`
};

}  // namespace flexneck::mesher
