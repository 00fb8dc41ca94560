// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>

#include "multibody/joints/joint.h"

namespace flexneck::multibody {

/// Coordinate: the angle, which determines the distance.
inline constexpr JointMotionLaw kScrewMotion{
    .rates = 1,
    .translates = true,
    .update =
        [](const JointFrame& frame, const Coordinates& q, const Coordinates&, JointMotion& motion) {
          motion.d = frame.lead_m_per_rad * q[0] * frame.axis_f;
          motion.R = turn_about(frame.axis_f, q[0]);
          motion.S.block<3, 1>(0, 0) = frame.lead_m_per_rad * frame.axis_m;
          motion.S.block<3, 1>(3, 0) = frame.axis_m;
        },
    .nearest =
        [](const JointFrame& frame, const Eigen::Matrix3d& R, const Eigen::Vector3d& d,
           Eigen::VectorXd& q) {
          // The distance determines the turn.
          constexpr double kTurn = 2 * std::numbers::pi;
          const double angle = angle_about(frame.axis_f, R);
          const double along = frame.axis_f.dot(d) / frame.lead_m_per_rad;
          q[0] = angle + kTurn * std::round((along - angle) / kTurn);
        }};

/// A joint that rotates about an axis and advances along it by the lead per turn.
inline constexpr JointKind kScrewJoint{
    .name = "screw",
    .translation = TranslationConstraint::across_axis,
    .rotation = RotationConstraint::common_axis,
    .axes = JointAxes::common,
    .has_angle = true,
    .length = {.key = "lead", .value = &Joint::lead_m, .may_be_negative = true},
    .advances = true,
    .motion = &kScrewMotion};

}  // namespace flexneck::multibody
