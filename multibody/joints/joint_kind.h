// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "multibody/joints/joint_motion.h"

namespace flexneck::multibody {

struct Joint;

/// What a joint holds of the positions of its markers' origins. The axis is that of marker i.
enum class TranslationConstraint {
  none,
  all,          ///< they are one point
  across_axis,  ///< that of marker j is on the axis through that of marker i
  along_axis,   ///< that of marker j is in the plane across the axis through that of marker i
  distance      ///< they are a length apart
};

/// What a joint holds of the orientations of its markers.
enum class RotationConstraint {
  none,
  all,          ///< they are the same
  common_axis,  ///< the axes of i and j are the same
  crossed_axes  ///< the axis of i is perpendicular to the second axis, of j
};

/// The axes that a joint needs.
enum class JointAxes {
  none,
  common,  ///< one, with the same components in the axes of both markers
  two      ///< one of marker i, and a second one of marker j
};

/// A length that a kind of joint needs.
struct JointLength {
  std::string_view key = {};       ///< in files; empty: the kind needs none
  double Joint::*value = nullptr;  ///< not zero
  bool may_be_negative = false;
};

/// A kind of joint: all that files, checks, forces and formulations know of it.
struct JointKind {
  std::string_view name;
  std::string_view alias = {};  ///< another name in files
  TranslationConstraint translation = TranslationConstraint::none;
  RotationConstraint rotation = RotationConstraint::none;
  JointAxes axes = JointAxes::none;
  bool has_distance = false;  ///< of marker j along the axis, a joint coordinate
  bool has_angle = false;     ///< of marker j about the axis, a joint coordinate
  JointLength length = {};
  bool advances = false;  ///< the distance is the angle times lead / 2 pi
  /// The motion that it leaves, for the recursive formulation; with none it can hang no body on
  /// another, and only closes loops in the descriptor formulation.
  const JointMotionLaw* motion = nullptr;

  constexpr bool holds_nothing() const {
    return translation == TranslationConstraint::none && rotation == RotationConstraint::none;
  }
};

}  // namespace flexneck::multibody
