// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/joints/joint_kind.h"

namespace flexneck::multibody {

/// Coordinate: the distance.
inline constexpr JointMotionLaw kPrismaticMotion{
    .rates = 1,
    .distances = 1,
    .translates = true,
    .update =
        [](const JointFrame& frame, const Coordinates& q, const Coordinates&, JointMotion& motion) {
          motion.d = q[0] * frame.axis_f;
          motion.S.block<3, 1>(0, 0) = frame.axis_m;
        },
    .nearest = [](const JointFrame& frame, const Eigen::Matrix3d&, const Eigen::Vector3d& d,
                  Eigen::VectorXd& q) { q[0] = frame.axis_f.dot(d); }};

/// A joint that slides along an axis (ATB's slip joint).
inline constexpr JointKind kPrismaticJoint{.name = "prismatic",
                                           .translation = TranslationConstraint::across_axis,
                                           .rotation = RotationConstraint::all,
                                           .axes = JointAxes::common,
                                           .has_distance = true,
                                           .motion = &kPrismaticMotion};

}  // namespace flexneck::multibody
