// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// What a model of point masses with rotations keeps of a mesh: the corners of its elements.
struct CornerMasses {
  std::vector<std::int32_t> nodes;  ///< (n), ascending
  Eigen::VectorXd masses_kg;        ///< (n), int rho N of the shape functions of the corners alone
};

/// All masses are positive; mass and, where elements have straight edges, centre of mass are those
/// of the mesh.
CornerMasses lump_at_corners(const mesher::Mesh& mesh);

/// Rotation of each corner under a displacement of all nodes, half its curl, (3, n): the mean of
/// the elements that meet there, weighted with modulus times volume, so that where plate and rubber
/// meet it is that of the plate. Exact for rigid motions.
/// @param corners ascending
/// @param displacements (3, nodes of the mesh)
Eigen::Matrix3Xd corner_rotations(const mesher::Mesh& mesh,
                                  const std::vector<std::int32_t>& corners,
                                  const Eigen::Matrix3Xd& displacements);

}  // namespace flexneck::fe_modal
