// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/descriptor/coordinate_row.h"

#include <cmath>
#include <numbers>

namespace flexneck::multibody {

using Eigen::Vector3d;

std::vector<CoordinateRow> coordinate_rows(const Joint& joint) {
  std::vector<CoordinateRow> rows;
  if (joint.kind->advances)
    rows.push_back({.per_distance = 1, .per_angle = -joint.lead_m / (2 * std::numbers::pi)});
  for (const JointMotor& motor : joint.motors) {
    const bool slides = motor.coordinate == JointCoordinate::distance;
    rows.push_back(
        {.per_distance = slides ? 1.0 : 0.0, .per_angle = slides ? 0.0 : 1.0, .motor = &motor});
  }
  return rows;
}

double update_configuration(const Vector3d& axis, const NodeKinematics& i, const NodeKinematics& j,
                            CoordinateRow& row) {
  row.h = i.R * axis;
  row.arm = row.h.cross(i.p - j.p);
  const double along = row.value - row.per_distance * row.h.dot(j.p - i.p);
  if (row.per_angle == 0) return along;
  const double residual = along - row.per_angle * angle_about(axis, i.R.transpose() * j.R);
  return std::remainder(residual, 2 * std::numbers::pi * row.per_angle);
}

double velocity_residual(const NodeKinematics& i, const NodeKinematics& j,
                         const CoordinateRow& row) {
  return row.rate + row.per_distance * (row.h.dot(i.pd - j.pd) + row.arm.dot(i.Om)) +
         row.per_angle * row.h.dot(i.Om - j.Om);
}

double gamma(const NodeKinematics& i, const NodeKinematics& j, const CoordinateRow& row) {
  // h' = Om_i x h, and h'' = Om_i' x h + Om_i x h', the first part of which is in arm.
  const Vector3d turning = i.Om.cross(row.h);
  const double along = row.h.dot(j.gp - i.gp) - row.arm.dot(i.gr) - 2 * turning.dot(i.pd - j.pd) -
                       i.Om.cross(turning).dot(i.p - j.p);
  const double about = row.h.dot(j.gr - i.gr) - turning.dot(i.Om - j.Om);
  return row.per_distance * along + row.per_angle * about - row.second_rate;
}

}  // namespace flexneck::multibody
