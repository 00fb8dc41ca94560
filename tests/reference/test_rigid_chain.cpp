// SPDX-License-Identifier: GPL-3.0-or-later
// The rigid chain pin - ball - fixed, compared with equations in four coordinates without
// multipliers.
#include <cmath>
#include <numbers>

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using flexneck::testing::ModelBuilder;

namespace {

constexpr double kArmLength_m = 1.657;
constexpr double kNeckLength_m = 0.1438;
constexpr double kStart = std::numbers::pi / 3;
const Vector3d kGravity_m_s2(0, 0.5, -9.81);

RigidBody make_arm() {
  const double moment = 29.57 * kArmLength_m * kArmLength_m / 12;
  return {29.57, {0, 0, -kArmLength_m / 2}, Vector3d(moment, moment, 0.1).asDiagonal()};
}
RigidBody make_neck() {
  return {1, {0, 0, -kNeckLength_m / 2}, Vector3d(2e-3, 2e-3, 1e-3).asDiagonal()};
}
RigidBody make_head() { return {4.5, {0.01, 0, -0.1}, Vector3d(0.016, 0.024, 0.022).asDiagonal()}; }

Model make_chain() {
  ModelBuilder build;
  const Quaterniond turn(Eigen::AngleAxisd(kStart, Vector3d::UnitY()));
  const Vector3d arm_end = turn * Vector3d(0, 0, -kArmLength_m);
  const Vector3d neck_end = arm_end + turn * Vector3d(0, 0, -kNeckLength_m);
  const auto ground = build.ground();
  const auto arm = build.body("arm", make_arm(), {Vector3d::Zero(), turn});
  const auto neck = build.body("neck", make_neck(), {arm_end, turn});
  const auto head = build.body("head", make_head(), {neck_end, turn});
  build.joint("pivot", &kRevoluteJoint, build.marker("ground", ground), build.marker("eye", arm));
  build.joint("shoulder", &kSphericalJoint, build.marker("arm end", arm, {0, 0, -kArmLength_m}),
              build.marker("neck base", neck));
  build.joint("OC", &kFixedJoint, build.marker("neck top", neck, {0, 0, -kNeckLength_m}),
              build.marker("head joint", head));
  build.marker("head cg", head, make_head().center_m);
  build.model.gravity_m_s2 = kGravity_m_s2;
  return build.model;
}

Matrix3d skew(const Vector3d& v) {
  Matrix3d result;
  result << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return result;
}

/// Neck and head as one body about its centre of mass, in the neck's frame.
struct Composite {
  double mass;
  Vector3d center;
  Matrix3d inertia;
};

Composite make_composite() {
  const RigidBody neck = make_neck();
  const RigidBody head = make_head();
  const Vector3d head_center = head.center_m + Vector3d(0, 0, -kNeckLength_m);
  Composite both;
  both.mass = neck.mass_kg + head.mass_kg;
  both.center = (neck.mass_kg * neck.center_m + head.mass_kg * head_center) / both.mass;
  const Matrix3d to_neck = skew(neck.center_m - both.center);
  const Matrix3d to_head = skew(head_center - both.center);
  both.inertia = neck.inertia_kg_m2 + head.inertia_kg_m2 - neck.mass_kg * to_neck * to_neck -
                 head.mass_kg * to_head * to_head;
  return both;
}

/// The arm's angle, the orientation of neck and head, and their rates (w in body axes).
struct Chain {
  double angle = kStart;
  double rate = 0;
  Quaterniond turn{Eigen::AngleAxisd(kStart, Vector3d::UnitY())};
  Vector3d w = Vector3d::Zero();
};

/// Accelerations by Kane's equations: each body's inertia force through its partial velocities.
Eigen::Vector4d accelerations(const Chain& chain) {
  static const Composite both = make_composite();
  static const RigidBody arm = make_arm();
  const double s = std::sin(chain.angle);
  const double c = std::cos(chain.angle);
  // End of the arm: p = L (-sin, 0, -cos); partial velocity p' = L (-cos, 0, sin).
  const Vector3d partial = kArmLength_m * Vector3d(-c, 0, s);
  const Vector3d centripetal = chain.rate * chain.rate * kArmLength_m * Vector3d(s, 0, c);
  const Matrix3d R = chain.turn.toRotationMatrix();
  // Centre of neck and head: a = partial angle'' - R ~c w' + known.
  const Matrix3d lever = -R * skew(both.center);
  const Vector3d known = centripetal + R * chain.w.cross(chain.w.cross(both.center));
  const double pivot_inertia = arm.inertia_kg_m2(1, 1) + arm.mass_kg * arm.center_m.squaredNorm();
  Eigen::Matrix4d mass;
  mass(0, 0) = pivot_inertia + both.mass * partial.squaredNorm();
  mass.block<1, 3>(0, 1) = both.mass * partial.transpose() * lever;
  mass.block<3, 1>(1, 0) = mass.block<1, 3>(0, 1).transpose();
  mass.block<3, 3>(1, 1) = both.inertia + both.mass * lever.transpose() * lever;
  const Vector3d lack = both.mass * (kGravity_m_s2 - known);
  Eigen::Vector4d load;
  load[0] = partial.dot(arm.mass_kg / 2 * kGravity_m_s2 + lack);
  load.tail<3>() = lever.transpose() * lack - chain.w.cross(both.inertia * chain.w);
  return mass.ldlt().solve(load);
}

struct ChainRate {
  double angle, rate;
  Eigen::Vector4d turn;
  Vector3d w;
};

ChainRate rate_of(const Chain& chain) {
  const Eigen::Vector4d a = accelerations(chain);
  const Quaterniond spin(0, chain.w.x(), chain.w.y(), chain.w.z());
  return {chain.rate, a[0], 0.5 * (chain.turn * spin).coeffs(), a.tail<3>()};
}

Chain moved(const Chain& chain, const ChainRate& rate, double h) {
  Chain next;
  next.angle = chain.angle + h * rate.angle;
  next.rate = chain.rate + h * rate.rate;
  next.turn.coeffs() = chain.turn.coeffs() + h * rate.turn;
  next.turn.normalize();
  next.w = chain.w + h * rate.w;
  return next;
}

/// State after one second by the classical Runge-Kutta method.
Chain after_one_second(int steps) {
  Chain chain;
  const double h = 1.0 / steps;
  for (int k = 0; k < steps; ++k) {
    const ChainRate k1 = rate_of(chain);
    const ChainRate k2 = rate_of(moved(chain, k1, h / 2));
    const ChainRate k3 = rate_of(moved(chain, k2, h / 2));
    const ChainRate k4 = rate_of(moved(chain, k3, h));
    const auto mean = [](const auto& a, const auto& b, const auto& c, const auto& d) {
      return ((a + 2 * b + 2 * c + d) / 6);
    };
    const ChainRate mixed{mean(k1.angle, k2.angle, k3.angle, k4.angle),
                          mean(k1.rate, k2.rate, k3.rate, k4.rate),
                          mean(k1.turn, k2.turn, k3.turn, k4.turn), mean(k1.w, k2.w, k3.w, k4.w)};
    chain = moved(chain, mixed, h);
  }
  return chain;
}

Vector3d head_center(const Chain& chain) {
  const Vector3d arm_end =
      kArmLength_m * Vector3d(-std::sin(chain.angle), 0, -std::cos(chain.angle));
  return arm_end + chain.turn * (make_head().center_m + Vector3d(0, 0, -kNeckLength_m));
}

Vector3d simulated(double tolerance) {
  const SolverOptions solver = flexneck::testing::solver_of(tolerance, 1e-2 * tolerance);
  const History history = simulate(make_chain(), solver, {.end_time_s = 1, .interval_s = 0.5});
  CHECK(history.statistics.max_position_residual < 1e-11);
  return history.marker("head cg").position_m.col(2);
}

}  // namespace

TEST_CASE("Generalised-alpha's error on the rigid chain falls with the tolerance to 1e-8") {
  const Vector3d reference = head_center(after_one_second(20000));
  const auto error = [&](double relative, double absolute) {
    SolverOptions solver = flexneck::testing::solver_of(relative, absolute);
    solver.integrator = Integrator::generalised_alpha;
    const History history = simulate(make_chain(), solver, {.end_time_s = 1, .interval_s = 1});
    return (history.marker("head cg").position_m.col(1) - reference).norm();
  };
  // The method is of order 2, so the error goes with the power 2/3 of the tolerance: a factor of 22
  // from 1e-6 to 1e-8.
  const double coarse = error(1e-6, 1e-11);
  CHECK(coarse < 6e-5);
  CHECK(error(1e-8, 1e-11) < coarse / 15);
}

TEST_CASE("A rigid chain of pin, ball and fixed joint moves as its own four coordinates do") {
  const Vector3d reference = head_center(after_one_second(20000));
  // The reference itself is converged.
  REQUIRE((head_center(after_one_second(10000)) - reference).norm() < 1e-11);
  CHECK((simulated(1e-12) - reference).norm() < 1e-9);
  // The error follows the tolerance.
  CHECK((simulated(1e-9) - reference).norm() < 1e-7);
  CHECK((simulated(1e-6) - reference).norm() < 1e-4);
}
