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

/// Which of a joint's motions a resistance acts on or a motor gives.
enum class JointCoordinate {
  distance,  ///< of j along the axis (JointKind::has_distance)
  angle,     ///< of j about the axis (JointKind::has_angle), which counts turns
  flexion    ///< in [0, pi] between the axis on i and on j, of any joint; it has no negative side
};

/// Makes a joint's distance or angle follow a function of time, whatever load that takes, which is
/// part of the joint's reaction.
struct JointMotor {
  std::string name;
  JointCoordinate coordinate = JointCoordinate::angle;
  double start = 0;  ///< m or rad, to which the path is added
  PrescribedCoordinate path;
};

/// Joins two markers. Its reaction is what body i exerts on body j, so let i be the lower one.
/// Where the markers' origins may part, its moment is about that of marker j.
struct Joint {
  std::string name;
  const JointKind* kind = &kFixedJoint;  ///< of joint_kinds.h
  std::size_t marker_i = 0;
  std::size_t marker_j = 0;
  /// Unit vector, where the kind has an axis: in the axes of both markers, or of marker i alone
  /// where there are two (JointAxes).
  Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
  Eigen::Vector3d second_axis = Eigen::Vector3d::UnitX();  ///< axes of marker j
  double lead_m = 0;    ///< of a screw joint: advance of j along the axis at a right-handed turn
  double length_m = 0;  ///< of a distance joint
  /// Tells the turn in which its angle starts: within half a turn of this. That of a screw joint is
  /// told by its distance.
  double start_angle_rad = 0;
  std::vector<JointMotor> motors = {};
};

}  // namespace flexneck::multibody
