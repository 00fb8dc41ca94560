// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/joints/fixed_joint.h"
#include "multibody/joints/joint_kind.h"
#include "multibody/numerics/prescribed_coordinate.h"

namespace flexneck::multibody {

/// The motion of a joint on which a resistance acts or which a motor prescribes.
enum class JointCoordinate {
  distance,  ///< distance of j along the axis (JointKind::has_distance)
  angle,     ///< angle of j about the axis (JointKind::has_angle), with turns counted
  flexion    ///< in [0, pi] between the axis on i and on j, of any joint; it has no negative side
};

/// Prescribes a joint's distance or angle as a function of time, whatever load this requires; the
/// load is part of the joint's reaction.
struct JointMotor {
  std::string name;
  JointCoordinate coordinate = JointCoordinate::angle;
  double start = 0;  ///< m or rad, the path is added to it
  PrescribedCoordinate path;
};

/// A joint between two markers. Its reaction is that of body i on body j, so let i be the lower
/// one. If the markers' origins may separate, its moment is about that of marker j.
struct Joint {
  std::string name;
  const JointKind* kind = &kFixedJoint;  ///< one of joint_kinds.h
  std::size_t marker_i = 0;
  std::size_t marker_j = 0;
  /// Unit vector, if the kind has an axis: in the axes of both markers, or of marker i alone if
  /// there are two axes (JointAxes).
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
  Eigen::Vector3d second_axis = Eigen::Vector3d::UnitX();  ///< axes of marker j
  double lead_m = 0;    ///< for a screw joint: advance of j along the axis per right-handed turn
  double length_m = 0;  ///< length of a distance joint
  /// Selects the turn in which its angle starts: within half a turn of this. That of a screw joint
  /// follows from its distance.
  double start_angle_rad = 0;
  std::vector<JointMotor> motors = {};
};

}  // namespace flexneck::multibody
