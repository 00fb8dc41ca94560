// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "multibody/joints/joint_kind.h"

namespace flexneck::multibody {

/// Coordinates: the angles about F's and M's axes.
inline constexpr JointMotionLaw kUniversalMotion{
    .rates = 2,
    .update =
        [](const JointFrame& frame, const Coordinates& q, const Coordinates& u,
           JointMotion& motion) {
          motion.R = turn_about(frame.axis_f, q[0]) * frame.R0 * turn_about(frame.axis_m, q[1]);
          const Eigen::Vector3d first = motion.R.transpose() * frame.axis_f;
          motion.S.block<3, 1>(3, 0) = first;
          motion.S.block<3, 1>(3, 1) = frame.axis_m;
          motion.S_dot_u = u[0] * u[1] * first.cross(frame.axis_m);
        },
    .nearest =
        [](const JointFrame& frame, const Eigen::Matrix3d& R, const Eigen::Vector3d&,
           Eigen::VectorXd& q) {
          const Eigen::Vector3d start = frame.R0 * frame.axis_m;
          const Eigen::Vector3d now = R * frame.axis_m;
          q[0] = std::atan2(frame.axis_f.dot(start.cross(now)), start.dot(now));
          q[1] =
              angle_about(frame.axis_m, frame.R0.transpose() * turn_about(frame.axis_f, -q[0]) * R);
        }};

/// A joint that keeps an axis of i perpendicular to one of j (ATB's Euler joint).
inline constexpr JointKind kUniversalJoint{.name = "universal",
                                           .translation = TranslationConstraint::all,
                                           .rotation = RotationConstraint::crossed_axes,
                                           .axes = JointAxes::two,
                                           .motion = &kUniversalMotion};

}  // namespace flexneck::multibody
