// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/model/prescribed_path.h"
#include "multibody/numerics/rotation.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/finite_differences.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using flexneck::skew;
using namespace flexneck::testing;
using Catch::Matchers::Contains;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kEnd_s = 0.5;
constexpr double kSwing = 0.7;  // rad
constexpr double kRate = 9;     // rad/s

SmoothMotion swing() {
  return SmoothMotion::of_displacement([](double t) { return kSwing * std::sin(kRate * t); },
                                       kEnd_s);
}

/// A path of all parts: a translation by a table and a function, a rotation by a rate, a table and
/// a function.
PrescribedPath path() {
  PrescribedBody body;
  body.direction = Vector3d(1, 2, -2) / 3;
  body.initial_velocity_m_s = 3;
  body.acceleration_m_s2 = TimeTable({0, 0.2, 1}, {-20, -10, 30}, TimeTable::Outside::zero);
  body.turn.axis = Vector3d(2, -1, 2) / 3;
  body.turn.point_m = {0.3, -0.2, 0.1};
  body.turn.initial_rate_rad_s = 1.5;
  body.turn.acceleration_rad_s2 = TimeTable({0, 1}, {4, -9}, TimeTable::Outside::zero);
  body.turn.motion = swing();
  const Eigen::Quaterniond start(Eigen::AngleAxisd(0.4, Vector3d(1, -2, 2) / 3));
  return {{{0.1, 0.5, -0.3}, start}, body};
}

/// A rod on a table that swings about z through the world's origin.
constexpr double kMass_kg = 2;
constexpr double kRadius_m = 0.3;
constexpr double kInertia_kg_m2 = 0.05;

/// Solver options with short steps: the table leaves the rod no freedom, so that no error shortens
/// the steps over which work is summed.
SolverOptions short_steps() {
  SolverOptions solver = solver_of(1e-9, 1e-12);
  solver.max_step_s = 5e-3;
  return solver;
}

ModelBuilder on_turntable() {
  ModelBuilder build;
  PrescribedBody table;
  table.turn.axis = Vector3d::UnitZ();
  table.turn.motion = swing();
  const auto prescribed = build.body("table", table);
  const Vector3d at(kRadius_m, 0, 0);
  const Vector3d w = kSwing * kRate * Vector3d::UnitZ();
  const auto rod = build.body(
      "rod", RigidBody{kMass_kg, Vector3d::Zero(), kInertia_kg_m2 * Matrix3d::Identity()}, {at},
      w.cross(at), w);
  build.joint("clamp", &kFixedJoint, build.marker("seat", prescribed),
              build.marker("foot", rod, -at));
  build.marker("rim", prescribed, at);
  build.marker("centre", rod);
  return build;
}

}  // namespace

TEST_CASE("velocities and accelerations of a prescribed body are derivatives of its motion") {
  const PrescribedPath prescribed = path();
  constexpr double kStep_s = 1e-4;
  // Error of fourth-order differences of motions with rates of some 10 / s; rounding 1e-16 / step.
  constexpr double kTolerance = 1e-8;
  for (const double t : {0.05, 0.31}) {
    const PrescribedMotion motion = prescribed.at(t);
    const auto slope = [&](const auto& of) { return first_derivative(of, kStep_s); };
    const Vector3d v = slope([&](double dt) { return prescribed.at(t + dt).position_m; });
    const Vector3d a = slope([&](double dt) { return prescribed.at(t + dt).velocity_m_s; });
    const Vector3d w_rate =
        slope([&](double dt) { return prescribed.at(t + dt).angular_velocity_rad_s; });
    const Matrix3d R_rate = slope([&](double dt) { return prescribed.at(t + dt).rotation; });
    CHECK((v - motion.velocity_m_s).norm() < kTolerance);
    CHECK((a - motion.acceleration_m_s2).norm() < kTolerance * kRate);
    CHECK((w_rate - motion.angular_acceleration_rad_s2).norm() < kTolerance * kRate);
    CHECK((R_rate - skew(motion.angular_velocity_rad_s) * motion.rotation).norm() < kTolerance);
  }
}

TEST_CASE("a rod clamped to a table that swings is carried, loaded and driven as it must") {
  const SolverOptions solver = short_steps();
  const History history = simulate(on_turntable().model, solver, {kEnd_s, 0.01});
  constexpr double kTolerance = 1e-7;
  const double start_J =
      0.5 * (kInertia_kg_m2 + kMass_kg * kRadius_m * kRadius_m) * std::pow(kSwing * kRate, 2);
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const double t = history.time_s[k];
    const double angle = kSwing * std::sin(kRate * t);
    const double rate = kSwing * kRate * std::cos(kRate * t);
    const double rate_rate = -kRate * kRate * angle;
    const Vector3d out(std::cos(angle), std::sin(angle), 0);
    const Vector3d on(-out.y(), out.x(), 0);
    const Vector3d expected = kRadius_m * (rate_rate * on - rate * rate * out);
    for (const char* marker : {"rim", "centre"}) {
      const MarkerHistory& found = history.marker(marker);
      CHECK((found.position_m.col(k) - kRadius_m * out).norm() < kTolerance);
      CHECK((found.velocity_m_s.col(k) - kRadius_m * rate * on).norm() < kTolerance * kRate);
      CHECK((found.acceleration_m_s2.col(k) - expected).norm() < kTolerance * kRate * kRate);
      CHECK(found.angular_velocity_rad_s(2, k) == Approx(rate).margin(kTolerance));
      CHECK(found.angular_acceleration_rad_s2(2, k) ==
            Approx(rate_rate).margin(kTolerance * kRate * kRate));
    }
    // The force is in the axes of the rotating seat; the moment is about the axis of the table.
    const JointHistory& clamp = history.joint("clamp");
    CHECK(clamp.force_N(0, k) == Approx(-kMass_kg * kRadius_m * rate * rate).margin(1e-5));
    CHECK(clamp.force_N(1, k) == Approx(kMass_kg * kRadius_m * rate_rate).margin(1e-5));
    const double inertia = kInertia_kg_m2 + kMass_kg * kRadius_m * kRadius_m;
    CHECK(clamp.moment_Nm(2, k) == Approx(inertia * rate_rate).margin(1e-5));
    CHECK(history.energy.work_J[k] ==
          Approx(0.5 * inertia * rate * rate - start_J).margin(1e-6 * start_J));
  }
}

TEST_CASE("a pendulum on the axis of a wheel does not feel the wheel turn") {
  const SolverOptions solver = solver_of(1e-9, 1e-12);
  const auto swinging = [&](bool turns) {
    ModelBuilder build;
    PrescribedBody wheel;
    if (turns) wheel.turn.acceleration_rad_s2 = constant_table(40);
    wheel.turn.point_m = {0.2, 0, 1};
    wheel.turn.initial_rate_rad_s = turns ? 12 : 0;
    build.model.gravity_m_s2 = {0, 0, -kGravity};
    const auto prescribed = build.body("wheel", wheel);
    const auto bob =
        build.body("bob", RigidBody{1, {0.3, 0, 0}, 0.01 * Matrix3d::Identity()}, {{0.2, 0, 1}});
    build.joint("axle", &kRevoluteJoint, build.marker("hub", prescribed, {0.2, 0, 1}),
                build.marker("eye", bob));
    build.marker("cg", bob, {0.3, 0, 0});
    return simulate(build.model, solver, {kEnd_s, 0.01});
  };
  const History turning = swinging(true);
  const History still = swinging(false);
  CHECK((turning.marker("cg").position_m - still.marker("cg").position_m).cwiseAbs().maxCoeff() <
        1e-8);
  // A revolute joint transmits no moment about its axis: the wheel does no work.
  CHECK(turning.energy.work_J.cwiseAbs().maxCoeff() < 1e-8);
  CHECK(turning.marker("hub").position_m.isApprox(still.marker("hub").position_m, 1e-14));
}

TEST_CASE("a spring takes in the work that a turning body does on it") {
  ModelBuilder build = on_turntable();
  const auto ground = build.ground();
  Resistance stretch;
  stretch.positive.curve = stretch.negative.curve = LoadCurve::cubic(500);
  build.model.forces.add(MarkerSpring{"spring", build.marker("wall", ground, {1, 0.2, 0}),
                                      build.model.marker_index("rim"), 0.5, stretch});
  const SolverOptions solver = short_steps();
  const EnergyHistory energy = simulate(build.model, solver, {kEnd_s, 0.01}).energy;
  const Eigen::VectorXd balance = energy.kinetic_J + energy.strain_J - energy.work_J;
  CHECK((balance.array() - balance[0]).abs().maxCoeff() < 1e-6 * energy.kinetic_J.maxCoeff());
  CHECK(energy.strain_J.maxCoeff() - energy.strain_J.minCoeff() > 1);
}

TEST_CASE(
    "a turning body works on what slides along it, whichever of the two the joint begins at") {
  // Along the slider a bead moves away as cosh(w t). Its centre is off the slider and the slider
  // off the axis: every arm of the reaction counts.
  constexpr double kSpin = 6;            // rad/s
  const Vector3d seat(0.1, -0.15, 0);    // on the wheel; the slider runs along x
  const Vector3d centre(0.02, 0.05, 0);  // centre of the bead, relative to its marker
  const bool wheel_first = GENERATE(true, false);
  ModelBuilder build;
  PrescribedBody prescribed;
  prescribed.turn.axis = Vector3d::UnitZ();
  prescribed.turn.initial_rate_rad_s = kSpin;
  const auto wheel = build.body("wheel", prescribed);
  const Vector3d w = kSpin * Vector3d::UnitZ();
  const auto bead =
      build.body("bead", RigidBody{kMass_kg, centre, kInertia_kg_m2 * Matrix3d::Identity()}, {seat},
                 w.cross(seat), w);
  const auto on_wheel = build.marker("seat", wheel, seat);
  const auto on_bead = build.marker("hole", bead);
  build.joint("slider", &kPrismaticJoint, wheel_first ? on_wheel : on_bead,
              wheel_first ? on_bead : on_wheel, Vector3d::UnitX());
  const SolverOptions solver = short_steps();
  const History history = simulate(build.model, solver, {0.3, 0.03});
  const double start_m = (seat + centre).x();
  const double across_m = (seat + centre).y();
  const auto kinetic_J = [&](double along_m, double speed_m_s) {
    return 0.5 * kMass_kg *
               (std::pow(speed_m_s - kSpin * across_m, 2) + std::pow(kSpin * along_m, 2)) +
           0.5 * kInertia_kg_m2 * kSpin * kSpin;
  };
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const double angle = kSpin * history.time_s[k];
    const double expected_J =
        kinetic_J(start_m * std::cosh(angle), start_m * kSpin * std::sinh(angle));
    CHECK(history.energy.kinetic_J[k] == Approx(expected_J).epsilon(1e-8));
    CHECK(history.energy.work_J[k] ==
          Approx(expected_J - kinetic_J(start_m, 0)).margin(1e-8 * expected_J));
  }
}

TEST_CASE("a start from equilibrium on a body that turns is refused") {
  CHECK_THROWS_WITH(simulate_from_equilibrium(on_turntable().model, {}, {}),
                    Contains("body 'table' rotates at time zero"));
}

TEST_CASE("a model without a free body runs: its prescribed bodies move, and nothing else") {
  ModelBuilder build;
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  PrescribedBody arm;
  arm.motion = swing();
  build.marker("hand", build.body("arm", arm), {0, 0, 1});
  SolverOptions solver;
  solver.formulation = either_formulation();
  solver.integrator = GENERATE(Integrator::dormand_prince, Integrator::generalised_alpha);
  const OutputOptions output{kEnd_s, 0.05};
  for (const History& history : {simulate(build.model, solver, output),
                                 simulate_from_equilibrium(build.model, solver, output),
                                 settle(build.model, solver, output)}) {
    REQUIRE(history.time_s.size() == 11);
    for (Eigen::Index k = 0; k < 11; ++k)
      CHECK(history.marker("hand").position_m(0, k) ==
            Approx(kSwing * std::sin(kRate * history.time_s[k])).margin(1e-12));
    CHECK(history.energy.work_J.isZero(0));
  }
  CHECK(system_modes(build.model).empty());
}
