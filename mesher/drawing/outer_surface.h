// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// The boundary as triangles, fine enough to show curved faces. The shape functions interpolate
/// fields at the nodes, (n) rows, to the vertices: `value * field`.
struct Surface {
  Eigen::SparseMatrix<double, Eigen::RowMajor> value;                ///< (vertices, nodes)
  Eigen::SparseMatrix<double, Eigen::RowMajor> along_xi, along_eta;  ///< derivatives on the face
  std::vector<std::array<std::int32_t, 3>> triangles;                ///< indices of their vertices
  std::vector<std::size_t> block_of_vertex;
  std::vector<std::vector<std::int32_t>> edges;     ///< element edges as chains of vertices
  std::vector<std::vector<std::int32_t>> outlines;  ///< edges between parts and at sharp bends
};

/// Triangulates the boundary of a mesh.
/// @param max_triangles bounds the subdivision of the facets
Surface surface_of(const Mesh& mesh, std::size_t max_triangles = 200'000);

}  // namespace flexneck::mesher
