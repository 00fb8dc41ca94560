// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/joints/joint_kind.h"

namespace flexneck::multibody {

inline constexpr JointMotionLaw kFixedMotion{
    .rates = 0,
    .update = [](const JointFrame&, const Coordinates&, const Coordinates&, JointMotion&) {},
    .nearest = [](const JointFrame&, const Eigen::Matrix3d&, const Eigen::Vector3d&,
                  Eigen::VectorXd&) {}};

/// A joint that constrains all motions.
inline constexpr JointKind kFixedJoint{.name = "fixed",
                                       .translation = TranslationConstraint::all,
                                       .rotation = RotationConstraint::all,
                                       .motion = &kFixedMotion};

}  // namespace flexneck::multibody
