// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck {

/// Skew matrix: skew(v) w = v x w. Written ~v in equations.md.
inline Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// [I, -skew(r)]: map from the translation and rotation of a point to the displacement at r from
/// it.
inline Eigen::Matrix<double, 3, 6> rigid_motions_at(const Eigen::Vector3d& r) {
  Eigen::Matrix<double, 3, 6> motions;
  motions << Eigen::Matrix3d::Identity(), -skew(r);
  return motions;
}

}  // namespace flexneck
