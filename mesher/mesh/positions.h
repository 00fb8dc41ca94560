// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// View of the positions of all nodes, (3, n) in m; valid as long as the mesh's nodes.
inline Eigen::Map<const Eigen::Matrix3Xd> positions_of(const Mesh& mesh) {
  static_assert(sizeof(mesh.nodes[0]) == 3 * sizeof(double));
  const double* const first = mesh.nodes.empty() ? nullptr : mesh.nodes.front().data();
  return {first, 3, static_cast<Eigen::Index>(mesh.nodes.size())};
}

/// Copies the positions of some nodes, such as an element's, in their order; positions_m is
/// resized.
inline void copy_positions(const Mesh& mesh, std::span<const std::int32_t> nodes,
                           Eigen::Matrix3Xd& positions_m) {
  const auto all = positions_of(mesh);
  positions_m.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    positions_m.col(static_cast<Eigen::Index>(k)) = all.col(nodes[k]);
}

/// Returns copy_positions() as a matrix.
inline Eigen::Matrix3Xd positions_of(const Mesh& mesh, std::span<const std::int32_t> nodes) {
  Eigen::Matrix3Xd positions_m;
  copy_positions(mesh, nodes, positions_m);
  return positions_m;
}

}  // namespace flexneck::mesher
