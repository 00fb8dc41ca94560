// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

#include "multibody/joints/joint_kinds.h"
#include "tests/support/test_models.h"

namespace flexneck::benchmarks {

inline multibody::RigidBody rod(double mass_kg, double length_m,
                                const Eigen::Vector3d& moments_kg_m2) {
  return {mass_kg, {0, 0, -length_m / 2}, moments_kg_m2.asDiagonal()};
}

/// Chain ground - pin - arm - ball - neck - fixed - head, released at 60 degrees, of the sizes with
/// which other programs were timed.
inline multibody::Model rigid_chain() {
  testing::ModelBuilder build;
  constexpr double kArm_m = 1.657;
  constexpr double kNeck_m = 0.1438;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(std::numbers::pi / 3, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d arm_end = turn * Eigen::Vector3d(0, 0, -kArm_m);
  const Eigen::Vector3d neck_end = arm_end + turn * Eigen::Vector3d(0, 0, -kNeck_m);
  const double moment = 29.57 * kArm_m * kArm_m / 12;
  const auto ground = build.ground();
  const auto arm =
      build.body("arm", rod(29.57, kArm_m, {moment, moment, 0.1}), {Eigen::Vector3d::Zero(), turn});
  const auto neck = build.body("neck", rod(1, kNeck_m, {2e-3, 2e-3, 1e-3}), {arm_end, turn});
  const Eigen::Vector3d head_center(0.01, 0, -0.1);
  const auto head = build.body(
      "head",
      multibody::RigidBody{4.5, head_center, Eigen::Vector3d(0.016, 0.024, 0.022).asDiagonal()},
      {neck_end, turn});
  build.joint("pivot", &multibody::kRevoluteJoint, build.marker("ground", ground),
              build.marker("eye", arm));
  build.joint("shoulder", &multibody::kSphericalJoint,
              build.marker("arm end", arm, {0, 0, -kArm_m}), build.marker("neck base", neck));
  build.joint("OC", &multibody::kFixedJoint, build.marker("neck top", neck, {0, 0, -kNeck_m}),
              build.marker("head joint", head));
  build.marker("head cg", head, head_center);
  build.model.gravity_m_s2 = {0, 0.5, -9.81};
  return build.model;
}

}  // namespace flexneck::benchmarks
