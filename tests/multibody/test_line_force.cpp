// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <catch2/catch.hpp>

#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using Catch::Matchers::Contains;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace flexneck::multibody;
using namespace flexneck::testing;

namespace {

RigidBody block(double mass_kg) { return {mass_kg, Vector3d::Zero(), Matrix3d::Identity()}; }

}  // namespace

TEST_CASE("a line force drives two free bodies apart by the integrals of its table") {
  constexpr double kLight_kg = 2;
  constexpr double kHeavy_kg = 5;
  const Vector3d line = Vector3d(1, -2, 2) / 3;
  ModelBuilder build;
  const auto light = build.body("light", block(kLight_kg));
  const auto heavy = build.body("heavy", block(kHeavy_kg), {0.5 * line});
  build.model.forces.add(LineForce{"actuator", build.marker("light", light),
                                   build.marker("heavy", heavy),
                                   TimeTable({0, 1, 2}, {0, 6, 0}, TimeTable::Outside::zero)});
  const History history =
      simulate(build.model, solver_of(1e-9, 1e-12), {.end_time_s = 3, .interval_s = 1});
  // The triangle's impulse is 6 N s and acts as if at 1 s.
  constexpr double kImpulse = 6;
  const auto moved = [&](const char* name) {
    return Vector3d(history.marker(name).position_m.col(3) -
                    history.marker(name).position_m.col(0));
  };
  CHECK((moved("light") + kImpulse * 2 / kLight_kg * line).norm() < 1e-8);
  CHECK((moved("heavy") - kImpulse * 2 / kHeavy_kg * line).norm() < 1e-8);
  CHECK((history.marker("heavy").velocity_m_s.col(3) - kImpulse / kHeavy_kg * line).norm() < 1e-8);
  CHECK(history.energy.work_J[3] ==
        Approx(kImpulse * kImpulse / 2 * (1 / kLight_kg + 1 / kHeavy_kg)).epsilon(1e-8));
}

TEST_CASE("what a line force takes from a prescribed body is not work on the others") {
  constexpr double kSpeed = 3;
  constexpr double kForce_N = 4;
  constexpr double kMass_kg = 2;
  ModelBuilder build;
  PrescribedBody sled;
  sled.direction = Vector3d::UnitX();
  sled.initial_velocity_m_s = -kSpeed;
  const auto from = build.marker("sled", build.body("sled", sled, {Vector3d(-1, 0, 0)}));
  const auto to = build.marker("block", build.body("block", block(kMass_kg)));
  build.model.forces.add(LineForce{"actuator", from, to, constant_table(kForce_N)});
  const History history =
      simulate(build.model, solver_of(1e-9, 1e-12), {.end_time_s = 1, .interval_s = 0.5});
  CHECK(history.marker("block").position_m(0, 2) == Approx(kForce_N / kMass_kg / 2).epsilon(1e-9));
  CHECK(history.energy.work_J[2] == Approx(kForce_N * kForce_N / kMass_kg / 2).epsilon(1e-8));
}

TEST_CASE("a block on a rail rests where a spring holds a line force from beside the rail") {
  constexpr double kBeside_m = 0.3;
  constexpr double kStiffness = 20;
  constexpr double kForce_N = 10;
  ModelBuilder build;
  const auto ground = build.ground();
  const auto on_rail = build.marker("block", build.body("block", block(2), {Vector3d(0.2, 0, 0)}));
  build.joint("rail", &kPrismaticJoint, build.marker("rail", ground), on_rail, Vector3d::UnitX());
  JointResistance spring{"spring", 0, JointCoordinate::distance, {}};
  spring.resistance.positive.curve = spring.resistance.negative.curve =
      LoadCurve::cubic(kStiffness);
  build.model.forces.add(spring);
  const auto beside = build.marker("beside", ground, {0, kBeside_m, 0});
  build.model.forces.add(LineForce{"actuator", beside, on_rail, constant_table(kForce_N)});
  SolverOptions solver;
  solver.formulation = either_formulation();
  const History history = settle(build.model, solver, {.end_time_s = 1, .interval_s = 1});
  // k x = F x / length: the length is F / k.
  const double length = kForce_N / kStiffness;
  CHECK(history.marker("block").position_m(0, 0) ==
        Approx(std::sqrt(length * length - kBeside_m * kBeside_m)).epsilon(1e-9));
}

TEST_CASE("a line force needs two bodies") {
  ModelBuilder build;
  const auto body = build.body("block", block(1));
  const auto tail = build.marker("tail", body);
  build.model.forces.add(
      LineForce{"actuator", tail, build.marker("nose", body, {1, 0, 0}), constant_table(1)});
  CHECK_THROWS_WITH(check(build.model),
                    Contains("line_force 'actuator'") && Contains("two bodies"));
}
