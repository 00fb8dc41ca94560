// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/bounding_box.h"

#include "mesher/mesh/positions.h"

namespace flexneck::mesher {

BoundingBox bounding_box(const Mesh& mesh) {
  const auto positions = positions_of(mesh);
  return {positions.rowwise().minCoeff(), positions.rowwise().maxCoeff()};
}

}  // namespace flexneck::mesher
