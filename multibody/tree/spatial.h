// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/numerics/rotation.h"
#include "multibody/tree/body_inertia.h"
#include "multibody/tree/tree_node.h"

// Spatial accelerations, loads and inertias, linear above angular, shifted between points and
// rotated between axes. Forced inline: they are the recursion's innermost work.
namespace flexneck::multibody::tree {

/// Z^T I Z with Z = [1, -~r; 0, 1]: an inertia at r, referred to the origin.
[[gnu::always_inline]] inline Matrix6d shifted(const Matrix6d& inertia, const Eigen::Vector3d& r) {
  const Eigen::Matrix3d cross = skew(r);
  Matrix6d result;
  const Eigen::Matrix3d tr = inertia.topRightCorner<3, 3>() - inertia.topLeftCorner<3, 3>() * cross;
  result.topLeftCorner<3, 3>() = inertia.topLeftCorner<3, 3>();
  result.topRightCorner<3, 3>() = tr;
  result.bottomLeftCorner<3, 3>() = tr.transpose();
  result.bottomRightCorner<3, 3>() = inertia.bottomRightCorner<3, 3>() -
                                     inertia.topRightCorner<3, 3>().transpose() * cross +
                                     cross * tr;
  return result;
}

/// Z^T f: a load at r, referred to the origin.
[[gnu::always_inline]] inline Vector6d shifted(const Vector6d& load, const Eigen::Vector3d& r) {
  Vector6d result = load;
  result.tail<3>() += r.cross(load.head<3>());
  return result;
}

/// Z a: an acceleration of the origin, referred to r.
[[gnu::always_inline]] inline Vector6d carried(const Vector6d& acceleration,
                                               const Eigen::Vector3d& r) {
  Vector6d result = acceleration;
  result.head<3>() += acceleration.tail<3>().cross(r);
  return result;
}

[[gnu::always_inline]] inline Vector6d rotated(const Eigen::Matrix3d& R, const Vector6d& v) {
  Vector6d result;
  result.head<3>().noalias() = R * v.head<3>();
  result.tail<3>().noalias() = R * v.tail<3>();
  return result;
}

[[gnu::always_inline]] inline Matrix6d rotated(const Eigen::Matrix3d& R, const Matrix6d& inertia) {
  Matrix6d result;
  const Eigen::Matrix3d tt = R * inertia.topLeftCorner<3, 3>();
  const Eigen::Matrix3d tr = R * inertia.topRightCorner<3, 3>();
  const Eigen::Matrix3d rr = R * inertia.bottomRightCorner<3, 3>();
  result.topLeftCorner<3, 3>().noalias() = tt * R.transpose();
  result.topRightCorner<3, 3>().noalias() = tr * R.transpose();
  result.bottomLeftCorner<3, 3>() = result.topRightCorner<3, 3>().transpose();
  result.bottomRightCorner<3, 3>().noalias() = rr * R.transpose();
  return result;
}

/// Bias of a node's acceleration: its terms other than [acc + wdot x s + psi a''; wdot + jm a''].
[[gnu::always_inline]] inline Vector6d node_bias(const NodeMotion& node, const Eigen::Vector3d& w) {
  Vector6d bias;
  bias.head<3>() = w.cross(w.cross(node.s) + 2 * node.s_dot) + node.s_dot_rate;
  bias.tail<3>() = w.cross(node.turn) + node.turn_rate;
  return bias;
}

}  // namespace flexneck::multibody::tree
