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
  const JointKind& kind = *joint.kind;
  const Vector3d gap = i.position_m - j.position_m;
  const Vector3d parting = i.velocity_m_s - j.velocity_m_s;
  switch (kind.translation) {
    case HeldTranslation::none:
      break;
    case HeldTranslation::all:
      position.translation = gap.squaredNorm();
      velocity.translation = parting.squaredNorm();
      break;
    case HeldTranslation::across_axis: {
      const Vector3d axis = i.rotation * joint.axis;
      position.translation = across(gap, axis).squaredNorm();
      velocity.translation =
          across(parting - i.angular_velocity_rad_s.cross(gap), axis).squaredNorm();
      break;
    }
    case HeldTranslation::along_axis: {
      const Vector3d axis = i.rotation * joint.axis;
      position.translation = square(axis.dot(gap));
      velocity.translation = square(axis.dot(parting - i.angular_velocity_rad_s.cross(gap)));
      break;
    }
  }
  if (kind.rotation == HeldRotation::none) return;
  const Vector3d turning = i.angular_velocity_rad_s - j.angular_velocity_rad_s;
  if (kind.rotation == HeldRotation::all) {
    // Of an angle t between the orientations the difference is sqrt(8) sin(t / 2).
    position.rotation = 0.5 * (i.rotation - j.rotation).squaredNorm();
    velocity.rotation = turning.squaredNorm();
    return;
  }
  const Vector3d axis_i = i.rotation * joint.axis;
  if (kind.rotation == HeldRotation::common_axis) {
    position.rotation = (axis_i - j.rotation * joint.axis).squaredNorm();
    velocity.rotation = across(turning, axis_i).squaredNorm();
  } else {
    const Vector3d axis_j = j.rotation * joint.second_axis;
    position.rotation = square(axis_i.dot(axis_j));
    velocity.rotation = square(axis_i.cross(axis_j).dot(turning));
  }
}

}  // namespace flexneck::multibody::tree
