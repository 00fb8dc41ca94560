// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/campaigns/deck.h"

namespace flexneck::campaigns {

Eigen::Matrix3d DeckAxes::frame() const {
  Eigen::Matrix3d axes;
  axes.col(2) = (on_z - origin).normalized();
  axes.col(1) = axes.col(2).cross(in_xz - origin).normalized();
  axes.col(0) = axes.col(1).cross(axes.col(2));
  return axes;
}

Eigen::Matrix3d DeckAxes::at(const Eigen::Vector3d& position) const {
  if (!is_cylindrical) return frame();
  return DeckAxes{false, origin, on_z, position, {}}.frame();
}

}  // namespace flexneck::campaigns
