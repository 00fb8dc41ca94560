// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "multibody/history/history.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// The plane in which a case bends the neck, in neck axes (x forward, y left, z to the head).
struct BendingPlane {
  Eigen::Vector3d motion;  ///< direction in which the arm moves or the load pushes
  Eigen::Vector3d tip;     ///< direction in which the head tips for a positive rotation: +x or +y
  Eigen::Vector3d axis;    ///< axis of that rotation, z cross tip
  /// Axes of the channels of SAE J211 for a load of the lower body on the upper one: Fx and My, or
  /// Fy and Mx; in an oblique plane those that Fx and My would have if x were the tip direction.
  Eigen::Vector3d shear, moment;
};

/// Plane of a direction.
/// @param oblique_angle_rad  angle of an oblique direction, from +x towards +y
BendingPlane bending_plane(CaseSection::Direction direction, double oblique_angle_rad = 0);
BendingPlane bending_plane(const CaseSection& experiment);

/// Rotation of a marker at output time k, marker to world.
Eigen::Quaterniond rotation_at(const multibody::MarkerHistory& marker, Eigen::Index k);

/// Angle of a rotation's component about an axis, rad in (-pi, pi].
double turn_about(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& axis);

/// Rotation of one marker against another about the plane's axis (the component of the rotation
/// vector), rad, at every output time.
Eigen::VectorXd relative_rotation(const multibody::MarkerHistory& marker,
                                  const multibody::MarkerHistory& reference,
                                  const BendingPlane& plane);

/// A reaction's moment about the plane's axis with the sign of SAE J211, N m.
Eigen::VectorXd bending_moment(const multibody::JointHistory& joint, const BendingPlane& plane);

}  // namespace flexneck::pipeline
