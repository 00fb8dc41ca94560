// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/joints/joint_kind.h"

namespace flexneck::multibody {

/// Coordinates: a quaternion.
inline constexpr JointMotionLaw kSphericalMotion{
    .rates = 3,
    .has_quaternion = true,
    .update =
        [](const JointFrame&, const Coordinates& q, const Coordinates&, JointMotion& motion) {
          motion.R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
          motion.S.block<3, 3>(3, 0).setIdentity();
        },
    .nearest =
        [](const JointFrame&, const Eigen::Matrix3d& R, const Eigen::Vector3d&,
           Eigen::VectorXd& q) {
          const Eigen::Quaterniond turn(R);
          q << turn.w(), turn.x(), turn.y(), turn.z();
        }};

/// A joint that rotates in every direction about a point.
inline constexpr JointKind kSphericalJoint{.name = "spherical",
                                           .alias = "ball",
                                           .translation = TranslationConstraint::all,
                                           .motion = &kSphericalMotion};

}  // namespace flexneck::multibody
