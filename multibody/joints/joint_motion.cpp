// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/joints/joint_motion.h"

#include <cmath>

namespace flexneck::multibody {

using Eigen::Vector3d;

double angle_about(const Vector3d& axis, const Eigen::Matrix3d& R) {
  const Eigen::Quaterniond q(R);
  const double sign = q.w() < 0 ? -1 : 1;
  return 2 * std::atan2(sign * q.vec().dot(axis), sign * q.w());
}

Eigen::Matrix<double, 2, 3> across(const Vector3d& h) {
  Eigen::Index smallest = 0;
  h.cwiseAbs().minCoeff(&smallest);
  const Vector3d first = h.cross(Vector3d::Unit(smallest)).normalized();
  Eigen::Matrix<double, 2, 3> rows;
  rows.row(0) = first.transpose();
  rows.row(1) = h.cross(first).transpose();
  return rows;
}

}  // namespace flexneck::multibody
