// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/joints/joint_kind.h"

namespace flexneck::multibody {

/// Coordinates: two distances across the axis, along across(axis), and the angle.
inline constexpr JointMotionLaw kPlanarMotion{
    .rates = 3,
    .distances = 2,
    .translates = true,
    .update =
        [](const JointFrame& frame, const Coordinates& q, const Coordinates&, JointMotion& motion) {
          const Eigen::Matrix<double, 2, 3> plane = across(frame.axis_f);
          motion.d = plane.transpose() * q.head<2>();
          motion.R = turn_about(frame.axis_f, q[2]);
          motion.S.block<3, 2>(0, 0) = motion.R.transpose() * plane.transpose();
          motion.S.block<3, 1>(3, 2) = frame.axis_m;
        },
    .nearest =
        [](const JointFrame& frame, const Eigen::Matrix3d& R, const Eigen::Vector3d& d,
           Eigen::VectorXd& q) {
          q.head<2>() = across(frame.axis_f) * d;
          q[2] = angle_about(frame.axis_f, R);
        }};

/// A joint that slides in the plane normal to an axis and rotates about the axis.
inline constexpr JointKind kPlanarJoint{.name = "planar",
                                        .translation = TranslationConstraint::along_axis,
                                        .rotation = RotationConstraint::common_axis,
                                        .axes = JointAxes::common,
                                        .has_angle = true,
                                        .motion = &kPlanarMotion};

}  // namespace flexneck::multibody
