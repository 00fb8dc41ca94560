// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// The piece of each element, the mesh's blocks in their order.
using PieceOfElement = std::vector<std::int32_t>;

/// A piece as a mesh of its own, in the frame of the whole.
struct MeshPiece {
  Mesh mesh;
  std::vector<std::int32_t> nodes;  ///< of the whole, by node of the piece; ascending
};

/// Elements, nodes and materials of one piece; no sets and no slits.
MeshPiece submesh(const Mesh& whole, const PieceOfElement& piece_of_element, std::int32_t piece);

}  // namespace flexneck::mesher
