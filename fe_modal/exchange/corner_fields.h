// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Corners of a mesh's elements with lumped masses, for a model of point masses with rotations.
struct CornerMasses {
  std::vector<std::int32_t> nodes;  ///< (n), ascending
  Eigen::VectorXd masses_kg;  ///< (n), int rho N over the shape functions of the corners alone
};

/// Lumps the mass at the corners. All masses are positive; mass and, if elements have straight
/// edges, centre of mass are those of the mesh.
CornerMasses lump_at_corners(const mesher::Mesh& mesh);

/// Rotation of each corner under a displacement of all nodes, half its curl, (3, n): the mean over
/// the elements at the corner, weighted with modulus times volume, so that between plate and rubber
/// it is that of the plate. Exact for rigid motions.
/// @param corners ascending
/// @param displacements (3, nodes of the mesh)
Eigen::Matrix3Xd corner_rotations(const mesher::Mesh& mesh,
                                  const std::vector<std::int32_t>& corners,
                                  const Eigen::Matrix3Xd& displacements);

}  // namespace flexneck::fe_modal
