// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include <Eigen/Core>

#include "multibody/joints/fixed_joint.h"
#include "multibody/joints/joint_kind.h"

namespace flexneck::multibody {

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
};

}  // namespace flexneck::multibody
