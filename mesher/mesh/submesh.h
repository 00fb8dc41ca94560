// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Number of the submesh of each element, the mesh's blocks in their order.
using PieceOfElement = std::vector<std::int32_t>;

/// A submesh, in the frame of the whole mesh.
struct MeshPiece {
  Mesh mesh;
  std::vector<std::int32_t> nodes;  ///< index in the whole mesh, by node of the submesh; ascending
};

/// Returns the elements, nodes and materials of one submesh; no sets and no slits.
MeshPiece submesh(const Mesh& whole, const PieceOfElement& piece_of_element, std::int32_t piece);

}  // namespace flexneck::mesher
