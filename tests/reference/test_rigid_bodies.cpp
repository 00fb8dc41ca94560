// SPDX-License-Identifier: GPL-3.0-or-later
// Published and closed-form motions of single rigid bodies.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using Eigen::Vector3d;
using flexneck::testing::kGravity;
using flexneck::testing::ModelBuilder;
using flexneck::testing::rotation_at;

namespace {

SolverOptions tight() { return flexneck::testing::solver_of(1e-11, 1e-12); }

RigidBody rigid(double mass_kg, const Vector3d& center_m, const Vector3d& moments_kg_m2) {
  return {mass_kg, center_m, moments_kg_m2.asDiagonal()};
}

}  // namespace

TEST_CASE("A pendulum released from horizontal has the period of the elliptic integral") {
  // L = 1 m: (I + m c^2) / (m c) with c = L / 2 and I = m L^2 / 4; T = 4 sqrt(L/g) K(sin 45 deg).
  constexpr double kPeriod_s = 2.3678419475762373;
  ModelBuilder build;
  const auto ground = build.ground();
  const Eigen::Quaterniond horizontal(Eigen::AngleAxisd(-std::numbers::pi / 2, Vector3d::UnitY()));
  const auto bob =
      build.body("bob", rigid(2, {0, 0, -0.5}, {0.6, 0.5, 0.3}), {Vector3d::Zero(), horizontal});
  const auto pivot = build.marker("pivot", ground);
  const auto eye = build.marker("eye", bob);
  build.marker("end", bob, {0, 0, -1});
  build.joint("pin", &kRevoluteJoint, pivot, eye);
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  const History history =
      simulate(build.model, tight(), {.end_time_s = 2 * kPeriod_s, .interval_s = kPeriod_s / 4});
  REQUIRE(history.time_s.size() == 9);
  const Eigen::Matrix3Xd& end = history.marker("end").position_m;
  // Gravity makes the end fall: horizontal at +x, down, horizontal at -x, down, and back.
  const Vector3d expected[] = {{1, 0, 0}, {0, 0, -1}, {-1, 0, 0}, {0, 0, -1}};
  for (Eigen::Index k = 0; k < 9; ++k) {
    CHECK((end.col(k) - expected[k % 4]).norm() < 1e-9);
  }
  // At the bottom: speed sqrt(2 g L), and the pin carries m g + m c w^2 with w^2 = 2 g / L.
  CHECK(history.marker("end").velocity_m_s.col(1).norm() ==
        Approx(std::sqrt(2 * kGravity)).epsilon(1e-9));
  CHECK(history.joint("pin").force_N(2, 1) == Approx(2 * (kGravity + kGravity)).epsilon(1e-8));
  CHECK(history.joint("pin").moment_Nm.cwiseAbs().maxCoeff() < 1e-8);
}

TEST_CASE("A free body flips about its intermediate axis with the period of Jacobi's functions") {
  constexpr double kPeriod_s = 41.50921953;
  constexpr double kQuarter_s = 10.37730488;
  const Vector3d moments(1, 2, 3);
  const Vector3d start(0.01, 1, 0);
  ModelBuilder build;
  const auto body =
      build.body("body", rigid(1, Vector3d::Zero(), moments), {}, Vector3d::Zero(), start);
  build.marker("frame", body);
  const SolverOptions solver = flexneck::testing::solver_of(1e-12, 1e-14);
  const History history =
      simulate(build.model, solver, {.end_time_s = kPeriod_s, .interval_s = kPeriod_s / 4});
  REQUIRE(history.time_s.size() == 5);
  const MarkerHistory& frame = history.marker("frame");
  const auto body_rate = [&](Eigen::Index k) -> Vector3d {
    return rotation_at(frame.rotation, k).conjugate() * frame.angular_velocity_rad_s.col(k);
  };
  // The period is known to 1e-8 s and the rates change by less than 0.58 / s^2 per second.
  constexpr double kTolerance = 1e-8;
  CHECK(std::abs(kPeriod_s / 4 - kQuarter_s) < 1e-8);
  CHECK(std::abs(body_rate(1)[1]) < kTolerance);
  CHECK(body_rate(2)[1] == Approx(-1).epsilon(kTolerance));
  CHECK((body_rate(4) - start).norm() < kTolerance);
  // Angular momentum is constant in the world.
  for (Eigen::Index k = 0; k < 5; ++k) {
    const Vector3d momentum = rotation_at(frame.rotation, k) * moments.cwiseProduct(body_rate(k));
    CHECK((momentum - moments.cwiseProduct(start)).norm() < 1e-9);
  }
}

TEST_CASE("The heavy top of Bruels, Cardona and Arnold is where it must be after 2 s") {
  ModelBuilder build;
  const auto ground = build.ground();
  const Vector3d center(0, 1, 0);
  const auto top = build.body("top", rigid(15, center, {0.234375, 0.46875, 0.234375}), {},
                              Vector3d::Zero(), {0, 150, -4.61538});
  const auto pivot = build.marker("pivot", ground);
  const auto tip = build.marker("tip", top);
  build.marker("cg", top, center);
  build.joint("ball", &kSphericalJoint, pivot, tip);
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  const History history = simulate(build.model, tight(), {.end_time_s = 2, .interval_s = 1});
  const Vector3d published(-0.15041682, -0.72416559, -0.67302227);
  // Eight decimals are published.
  CHECK((history.marker("cg").position_m.col(2) - published).norm() < 2e-8);
  // Newton's law for the whole body, from the kinematic acceleration: reaction = m (a - g).
  const Vector3d expected =
      15 * (history.marker("cg").acceleration_m_s2.col(2) - build.model.gravity_m_s2);
  CHECK((history.joint("ball").force_N.col(2) - expected).norm() < 1e-9 * expected.norm());
}

TEST_CASE("A body thrown without gravity goes straight on, and with it along a parabola") {
  const double gravity = GENERATE(0.0, kGravity);
  ModelBuilder build;
  const Vector3d velocity(3, -1, 4);
  const auto body =
      build.body("body", rigid(2, Vector3d::Zero(), {1, 2, 2.5}), {}, velocity, {1, 2, 3});
  build.marker("frame", body);
  build.model.gravity_m_s2 = {0, 0, -gravity};
  const History history = simulate(build.model, tight(), {.end_time_s = 1.3, .interval_s = 0.1});
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const double t = history.time_s[k];
    const Vector3d expected = t * velocity + 0.5 * t * t * build.model.gravity_m_s2;
    CHECK((history.marker("frame").position_m.col(k) - expected).norm() < 1e-11);
  }
}
