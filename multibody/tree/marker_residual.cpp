// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/tree/marker_residual.h"

#include <cmath>
#include <numbers>

namespace flexneck::multibody::tree {
namespace {

using Eigen::Vector3d;

Vector3d across(const Vector3d& vector, const Vector3d& axis) {
  return vector - vector.dot(axis) * axis;
}

double square(double value) { return value * value; }

}  // namespace

void SquaredResidual::add_advance(const Joint& joint, const MarkerState& i, const MarkerState& j) {
  const Vector3d axis = i.rotation * joint.axis;
  const Vector3d line = j.position_m - i.position_m;
  const Vector3d parting = j.velocity_m_s - i.velocity_m_s - i.angular_velocity_rad_s.cross(line);
  const double lead = joint.lead_m / (2 * std::numbers::pi);
  const double angle = angle_about(joint.axis, i.rotation.transpose() * j.rotation);
  position.translation += square(std::remainder(axis.dot(line) - lead * angle, joint.lead_m));
  velocity.translation +=
      square(axis.dot(parting - lead * (j.angular_velocity_rad_s - i.angular_velocity_rad_s)));
}

SquaredResidual::SquaredResidual(const Joint& joint, const MarkerState& i, const MarkerState& j)
    : position{0, 0}, velocity{0, 0} {
  const JointKind& kind = *joint.kind;
  const Vector3d gap = i.position_m - j.position_m;
  const Vector3d parting = i.velocity_m_s - j.velocity_m_s;
  switch (kind.translation) {
    case TranslationConstraint::none:
      break;
    case TranslationConstraint::all:
      position.translation = gap.squaredNorm();
      velocity.translation = parting.squaredNorm();
      break;
    case TranslationConstraint::across_axis: {
      const Vector3d axis = i.rotation * joint.axis;
      position.translation = across(gap, axis).squaredNorm();
      velocity.translation =
          across(parting - i.angular_velocity_rad_s.cross(gap), axis).squaredNorm();
      break;
    }
    case TranslationConstraint::along_axis: {
      const Vector3d axis = i.rotation * joint.axis;
      position.translation = square(axis.dot(gap));
      velocity.translation = square(axis.dot(parting - i.angular_velocity_rad_s.cross(gap)));
      break;
    }
    case TranslationConstraint::distance: {
      const double distance = gap.norm();
      position.translation = square(distance - joint.length_m);
      velocity.translation = square(gap.dot(parting) / distance);
      break;
    }
  }
  if (kind.rotation == RotationConstraint::none) return;
  const Vector3d turning = i.angular_velocity_rad_s - j.angular_velocity_rad_s;
  if (kind.rotation == RotationConstraint::all) {
    // For an angle t between the orientations the difference is sqrt(8) sin(t / 2).
    position.rotation = 0.5 * (i.rotation - j.rotation).squaredNorm();
    velocity.rotation = turning.squaredNorm();
    return;
  }
  const Vector3d axis_i = i.rotation * joint.axis;
  if (kind.rotation == RotationConstraint::common_axis) {
    position.rotation = (axis_i - j.rotation * joint.axis).squaredNorm();
    velocity.rotation = across(turning, axis_i).squaredNorm();
    if (kind.advances) add_advance(joint, i, j);
  } else {
    const Vector3d axis_j = j.rotation * joint.second_axis;
    position.rotation = square(axis_i.dot(axis_j));
    velocity.rotation = square(axis_i.cross(axis_j).dot(turning));
  }
}

}  // namespace flexneck::multibody::tree
