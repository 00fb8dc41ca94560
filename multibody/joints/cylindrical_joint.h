// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/joints/joint_kind.h"

namespace flexneck::multibody {

/// Coordinates: the distance and the angle.
inline constexpr JointMotionLaw kCylindricalMotion{
    .rates = 2,
    .distances = 1,
    .translates = true,
    .update =
        [](const JointFrame& frame, const Coordinates& q, const Coordinates&, JointMotion& motion) {
          motion.d = q[0] * frame.axis_f;
          motion.R = turn_about(frame.axis_f, q[1]);
          motion.S.block<3, 1>(0, 0) = frame.axis_m;
          motion.S.block<3, 1>(3, 1) = frame.axis_m;
        },
    .nearest =
        [](const JointFrame& frame, const Eigen::Matrix3d& R, const Eigen::Vector3d& d,
           Eigen::VectorXd& q) {
          q[0] = frame.axis_f.dot(d);
          q[1] = angle_about(frame.axis_f, R);
        }};

/// A joint that slides along an axis and rotates about it.
inline constexpr JointKind kCylindricalJoint{.name = "cylindrical",
                                             .translation = TranslationConstraint::across_axis,
                                             .rotation = RotationConstraint::common_axis,
                                             .axes = JointAxes::common,
                                             .has_distance = true,
                                             .has_angle = true,
                                             .motion = &kCylindricalMotion};

}  // namespace flexneck::multibody
