// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/bounding_box.h"

namespace flexneck::mesher {

BoundingBox bounding_box(const Mesh& mesh) {
  const Eigen::Vector3d first(mesh.nodes.front().data());
  BoundingBox box{first, first};
  for (const auto& node : mesh.nodes) {
    const Eigen::Map<const Eigen::Vector3d> x(node.data());
    box.low_m = box.low_m.cwiseMin(x);
    box.high_m = box.high_m.cwiseMax(x);
  }
  return box;
}

}  // namespace flexneck::mesher
