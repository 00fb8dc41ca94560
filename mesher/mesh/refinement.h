// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/SparseCore>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// A mesh with each element cut in eight and each face in four.
struct RefinedMesh {
  Mesh mesh;
  /// (nodes, nodes of the mesh before): the shape functions of the mesh before at each node, so
  /// that it carries fields and positions over.
  Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t> prolongation;
  /// Of each element of `mesh` the one that it was cut from, both counted block by block.
  std::vector<std::int32_t> parents;
};

/// Cuts every element along the planes that halve its reference element. The geometry stays what
/// the mesh made of it, curved elements included, and every field of the mesh before is one of the
/// new mesh too. Nodes keep their numbers and new ones follow. A new node belongs to a set if all
/// nodes do that its position hangs on: a fixed face, edge or single node stays just that. Slits
/// keep the pairs; their normals and areas, which no solver needs, are left out.
/// @pre the mesh is one that check() accepts
RefinedMesh refine(const Mesh& mesh);

}  // namespace flexneck::mesher
