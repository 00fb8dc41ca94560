// SPDX-License-Identifier: GPL-3.0-or-later
// Free motions of a screw, a planar and a distance joint, in closed form.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Catch::Matchers::Contains;
using Eigen::Index;
using Eigen::Vector3d;

namespace {

constexpr double kMass_kg = 2;
constexpr double kInertia_kg_m2 = 0.05;
constexpr double kEnd_s = 1;

RigidBody ball() {
  return {kMass_kg, Vector3d::Zero(), kInertia_kg_m2 * Eigen::Matrix3d::Identity()};
}

/// A ball under gravity, connected to the ground by a joint whose axis is x.
ModelBuilder ball_on(const JointKind* kind, const Vector3d& place_m, const Vector3d& gravity) {
  ModelBuilder build;
  build.model.gravity_m_s2 = gravity;
  const auto body = build.body("ball", ball(), {place_m});
  build.joint("joint", kind, build.marker("ground", build.ground()), build.marker("center", body),
              Vector3d::UnitX());
  return build;
}

}  // namespace

TEST_CASE("a nut on a screw falls as if it had the mass m + I / l^2, turn after turn") {
  const double lead_m = GENERATE(0.05, -0.05);
  const bool nut_first = GENERATE(false, true);
  constexpr double kGravity_m_s2 = 9;
  ModelBuilder build = ball_on(&kScrewJoint, Vector3d::Zero(), {kGravity_m_s2, 0, 0});
  Joint& joint = build.model.joints[0];
  joint.lead_m = lead_m;
  if (nut_first) std::swap(joint.marker_i, joint.marker_j);
  const double l = lead_m / (2 * std::numbers::pi);
  const double acceleration = kGravity_m_s2 * kMass_kg / (kMass_kg + kInertia_kg_m2 / (l * l));
  const History history = simulate(build.model, solver_of(1e-11, 1e-13), {.end_time_s = 10});
  const Index last = history.time_s.size() - 1;
  const MarkerHistory& nut = history.marker("center");
  const double fallen = acceleration * 100 / 2;
  CHECK(fallen / std::abs(lead_m) > 10);  // turns
  CHECK(nut.position_m(0, last) == Approx(fallen).epsilon(1e-9));
  CHECK(nut.angular_velocity_rad_s(0, last) == Approx(acceleration * 10 / l).epsilon(1e-9));
  // The thread carries the rest of the weight.
  const Vector3d force = history.joints[0].force_N.col(last);
  const double held = kMass_kg * (kGravity_m_s2 - acceleration);
  CHECK(force.x() == Approx((nut_first ? 1 : -1) * held).epsilon(1e-9));
  CHECK(history.joints[0].moment_Nm(0, last) == Approx(-l * force.x()).epsilon(1e-9));
}

TEST_CASE("a disc on a plane flies along a parabola in it and keeps its spin") {
  ModelBuilder build = ball_on(&kPlanarJoint, {0, 0.3, -0.1}, {-4, 0, -9});
  build.model.bodies[0].initial_velocity_m_s = {0, 2, 1};
  build.model.bodies[0].initial_angular_velocity_rad_s = {7, 0, 0};
  const History history = simulate(build.model, solver_of(1e-10, 1e-12), {.end_time_s = kEnd_s});
  const Index last = history.time_s.size() - 1;
  const MarkerHistory& disc = history.marker("center");
  CHECK((disc.position_m.col(last) - Vector3d(0, 2.3, 0.9 - 4.5)).norm() < 1e-9);
  CHECK((disc.angular_velocity_rad_s.col(last) - Vector3d(7, 0, 0)).norm() < 1e-9);
  CHECK((history.joints[0].force_N.col(last) - Vector3d(4 * kMass_kg, 0, 0)).norm() < 1e-8);
}

TEST_CASE("a ball on a rod swings with the period of a simple pendulum") {
  constexpr double kLength_m = 0.8;
  constexpr double kAmplitude = 2;  // rad
  constexpr double kGravity_m_s2 = 9;
  ModelBuilder build = ball_on(
      &kDistanceJoint, {kLength_m * std::sin(kAmplitude), 0, -kLength_m * std::cos(kAmplitude)},
      {0, 0, -kGravity_m_s2});
  build.model.joints[0].length_m = kLength_m;
  const double period =
      4 * std::sqrt(kLength_m / kGravity_m_s2) * std::comp_ellint_1(std::sin(kAmplitude / 2));
  const SolverOptions solver{.relative_tolerance = 1e-10, .absolute_tolerance = 1e-12};
  const History history =
      simulate(build.model, solver, {.end_time_s = period, .interval_s = period / 4});
  const MarkerHistory& swung = history.marker("center");
  CHECK((swung.position_m.col(4) - swung.position_m.col(0)).norm() < 1e-7);
  CHECK((swung.position_m.col(1) - Vector3d(0, 0, -kLength_m)).norm() < 1e-8);
  // At the bottom the rod pulls by the weight and 2 (1 - cos) of it.
  const double pull = kMass_kg * kGravity_m_s2 * (1 + 2 * (1 - std::cos(kAmplitude)));
  CHECK((history.joints[0].force_N.col(1) - Vector3d(0, 0, pull)).norm() < 1e-6);
  CHECK(history.joints[0].moment_Nm.norm() == 0);
  // It transmits no rotation.
  CHECK(swung.angular_velocity_rad_s.norm() < 1e-12);
}

TEST_CASE("the recursive formulation refuses a distance joint, and lengths are checked") {
  ModelBuilder build = ball_on(&kDistanceJoint, {0, 0, 1}, Vector3d::Zero());
  CHECK_THROWS_WITH(check(build.model), Contains("joint 'joint'") && Contains("length must be"));
  build.model.joints[0].length_m = 1;
  const SolverOptions recursive{.formulation = Formulation::recursive};
  CHECK_THROWS_WITH(simulate(build.model, recursive, {}),
                    Contains("joint 'joint' is of the kind distance") && Contains("descriptor"));
  build.model.joints[0].length_m = 0.9;
  CHECK_THROWS_WITH(simulate(build.model, {}, {}), Contains("0.1 m and 0 rad apart"));
  CHECK_THROWS_WITH(check(ball_on(&kScrewJoint, {0, 0, 1}, Vector3d::Zero()).model),
                    Contains("lead must be other than zero"));
}
