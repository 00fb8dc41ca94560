// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

struct BoundingBox {
  Eigen::Vector3d low_m;
  Eigen::Vector3d high_m;

  Eigen::Vector3d extent_m() const { return high_m - low_m; }
  Eigen::Vector3d center_m() const { return low_m + extent_m() / 2; }
};

/// @pre the mesh has nodes
BoundingBox bounding_box(const Mesh& mesh);

}  // namespace flexneck::mesher
