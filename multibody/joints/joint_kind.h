// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "multibody/joints/joint_motion.h"

namespace flexneck::multibody {

struct Joint;

/// Constraint of the positions of a joint's markers' origins. The axis is that of marker i.
enum class TranslationConstraint {
  none,
  all,          ///< the origins coincide
  across_axis,  ///< the origin of j is on the axis through that of i
  along_axis,   ///< the origin of j is in the plane normal to the axis through that of i
  distance      ///< the origins are a given length apart
};

/// Constraint of the orientations of a joint's markers.
enum class RotationConstraint {
  none,
  all,          ///< the orientations are equal
  common_axis,  ///< the axes of i and j are equal
  crossed_axes  ///< the axis of i is perpendicular to the second axis, of j
};

/// The axes that a joint needs.
enum class JointAxes {
  none,
  common,  ///< one axis, with the same components in the axes of both markers
  two      ///< an axis of marker i, and a second one of marker j
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
  bool has_distance = false;  ///< distance of marker j along the axis, a joint coordinate
  bool has_angle = false;     ///< angle of marker j about the axis, a joint coordinate
  JointLength length = {};
  bool advances = false;  ///< the distance is the angle times lead / 2 pi
  /// The free motion, for the recursive formulation; without it the joint can connect no body to a
  /// tree, and only closes loops in the descriptor formulation.
  const JointMotionLaw* motion = nullptr;

  constexpr bool holds_nothing() const {
    return translation == TranslationConstraint::none && rotation == RotationConstraint::none;
  }
};

}  // namespace flexneck::multibody
