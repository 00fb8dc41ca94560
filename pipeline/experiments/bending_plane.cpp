// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/bending_plane.h"

#include <cmath>
#include <numbers>

namespace flexneck::pipeline {

BendingPlane bending_plane(CaseSection::Direction direction, double oblique_angle_rad) {
  using Direction = CaseSection::Direction;
  using Eigen::Vector3d;
  const bool lateral = direction == Direction::lateral;
  Vector3d tip = lateral ? Vector3d::UnitY() : Vector3d::UnitX();
  if (direction == Direction::oblique)
    tip = {std::cos(oblique_angle_rad), std::sin(oblique_angle_rad), 0};
  const Vector3d axis = Vector3d::UnitZ().cross(tip);
  // In SAE J211 y points right: Fy is positive against the tip direction, Fx along it.
  const Vector3d shear = lateral ? Vector3d(-tip) : tip;
  return {direction == Direction::extension ? Vector3d(-tip) : tip, tip, axis, shear, -axis};
}

BendingPlane bending_plane(const CaseSection& experiment) {
  return bending_plane(experiment.direction, experiment.oblique_angle_rad);
}

Eigen::Quaterniond rotation_at(const multibody::MarkerHistory& marker, Eigen::Index k) {
  const auto q = marker.rotation.col(k);
  return {q[0], q[1], q[2], q[3]};
}

double turn_about(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& axis) {
  const double sign = rotation.w() < 0 ? -1 : 1;
  return 2 * std::atan2(sign * rotation.vec().dot(axis), sign * rotation.w());
}

Eigen::VectorXd relative_rotation(const multibody::MarkerHistory& marker,
                                  const multibody::MarkerHistory& reference,
                                  const BendingPlane& plane) {
  Eigen::VectorXd angles(marker.rotation.cols());
  for (Eigen::Index k = 0; k < angles.size(); ++k) {
    const Eigen::AngleAxisd turn(rotation_at(reference, k).conjugate() * rotation_at(marker, k));
    const double angle = turn.angle() * turn.axis().dot(plane.axis);
    // The angle is continued beyond half a turn.
    const double before = k > 0 ? angles[k - 1] : 0;
    angles[k] = before + std::remainder(angle - before, 2 * std::numbers::pi);
  }
  return angles;
}

Eigen::VectorXd bending_moment(const multibody::JointHistory& joint, const BendingPlane& plane) {
  return joint.moment_Nm.transpose() * plane.moment;
}

}  // namespace flexneck::pipeline
