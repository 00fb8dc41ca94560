// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/joints/joint_kind.h"

namespace flexneck::multibody {

/// Coordinate: the angle.
inline constexpr JointMotionLaw kRevoluteMotion{
    .rates = 1,
    .update =
        [](const JointFrame& frame, const Coordinates& q, const Coordinates&, JointMotion& motion) {
          motion.R = turn_about(frame.axis_f, q[0]);
          motion.S.block<3, 1>(3, 0) = frame.axis_m;
        },
    .nearest = [](const JointFrame& frame, const Eigen::Matrix3d& R, const Eigen::Vector3d&,
                  Eigen::VectorXd& q) { q[0] = angle_about(frame.axis_f, R); }};

/// A joint that rotates about an axis.
inline constexpr JointKind kRevoluteJoint{.name = "revolute",
                                          .alias = "pin",
                                          .translation = TranslationConstraint::all,
                                          .rotation = RotationConstraint::common_axis,
                                          .axes = JointAxes::common,
                                          .has_angle = true,
                                          .motion = &kRevoluteMotion};

}  // namespace flexneck::multibody
