// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/SparseCore>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// A mesh with each element cut in eight and each face in four, or each of a higher order.
struct RefinedMesh {
  Mesh mesh;
  /// (nodes, coarse nodes): the shape functions of the coarse mesh at each node, which interpolate
  /// its fields and positions.
  Eigen::SparseMatrix<double, Eigen::RowMajor, std::int32_t> prolongation;
  /// Parent of each element of `mesh` in the coarse mesh, both counted block by block.
  std::vector<std::int32_t> parents;
};

/// Divides every element along the planes that halve its reference element. The geometry of the
/// coarse mesh is kept, curved elements included, and every field of the coarse mesh is also one of
/// the new mesh. Nodes keep their numbers and new ones follow. A new node belongs to a set if all
/// nodes that determine its position do: a fixed face, edge or single node stays just that. Slits
/// keep the pairs; their normals and areas, which no solver needs, are left out.
/// @pre the mesh is one that check() accepts
RefinedMesh refine(const Mesh& mesh);

/// Puts quadratic elements in place of the linear ones, whose shapes they keep: 27-node hexahedra,
/// 18-node prisms, 10-node tetrahedra and 14-node pyramids. All else is as refine() makes it, and
/// so are the nodes.
RefinedMesh raise_order(const Mesh& mesh);

}  // namespace flexneck::mesher
