// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/marker_residual.h"

namespace flexneck::multibody::tree {
namespace {

using Eigen::Vector3d;

Vector3d across(const Vector3d& vector, const Vector3d& axis) {
  return vector - vector.dot(axis) * axis;
}

double square(double value) { return value * value; }

}  // namespace

SquaredResidual::SquaredResidual(const Joint& joint, const MarkerState& i, const MarkerState& j)
    : position{0, 0}, velocity{0, 0} {
  if (joint.kind == JointKind::free) return;
  Vector3d gap = i.position_m - j.position_m;
  Vector3d parting = i.velocity_m_s - j.velocity_m_s;
  const Vector3d turning = i.angular_velocity_rad_s - j.angular_velocity_rad_s;
  const auto hold_orientation = [&] {
    // Of an angle t between the orientations the difference is sqrt(8) sin(t / 2).
    position.rotation = 0.5 * (i.rotation - j.rotation).squaredNorm();
    velocity.rotation = turning.squaredNorm();
  };
  if (joint.kind == JointKind::fixed) {
    position.translation = gap.squaredNorm();
    velocity.translation = parting.squaredNorm();
    hold_orientation();
    return;
  }
  Vector3d axis_i = Vector3d::Zero();
  Vector3d axis_j = Vector3d::Zero();
  const bool slides = joint.kind == JointKind::slider || joint.kind == JointKind::cylindrical;
  const bool is_universal = joint.kind == JointKind::universal;
  if (slides || is_universal || joint.kind == JointKind::pin) {
    axis_i.noalias() = i.rotation * joint.axis;
    axis_j.noalias() = j.rotation * (is_universal ? joint.second_axis : joint.axis);
  }
  if (slides) {
    parting = across(parting - i.angular_velocity_rad_s.cross(gap), axis_i);
    gap = across(gap, axis_i);
  }
  position.translation = gap.squaredNorm();
  velocity.translation = parting.squaredNorm();
  switch (joint.kind) {
    case JointKind::slider:
      hold_orientation();
      return;
    case JointKind::pin:
    case JointKind::cylindrical:
      position.rotation = (axis_i - axis_j).squaredNorm();
      velocity.rotation = across(turning, axis_i).squaredNorm();
      return;
    case JointKind::universal:
      position.rotation = square(axis_i.dot(axis_j));
      velocity.rotation = square(axis_i.cross(axis_j).dot(turning));
      return;
    default:
      return;
  }
}

}  // namespace flexneck::multibody::tree
