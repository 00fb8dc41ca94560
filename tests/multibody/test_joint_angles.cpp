// SPDX-License-Identifier: GPL-3.0-or-later
// Angles of joints and measured angles count turns, for every formulation, integrator and interval
// of the outputs.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "multibody/simulation/stepped_run.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using Eigen::Quaterniond;
using Eigen::Vector3d;
using namespace flexneck::multibody;
using namespace flexneck::testing;

namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kStiffness = 2;  ///< N m/rad
constexpr double kInertia = 0.5;  ///< kg m^2
constexpr double kMass = 1.3;     ///< kg
constexpr double kLead = 0.4;     ///< m
const Vector3d kAxis = Vector3d(1, -2, 2) / 3;

/// A wheel connected to the ground by a joint with an angle, with an initial angle and rate.
/// @param outwards  true if the ground is the joint's marker i
Model wheel(const JointKind& kind, double angle_rad, double rate_rad_s, bool outwards = true) {
  ModelBuilder build;
  const double sign = outwards ? 1 : -1;  // sign of the wheel's rotation
  const double lead = kind.advances ? kLead / kTurn : 0;
  const Pose pose{
      outwards ? Vector3d(lead * angle_rad * kAxis) : Vector3d(-lead * angle_rad * kAxis),
      Quaterniond(Eigen::AngleAxisd(sign * angle_rad, kAxis))};
  build.ground();
  build.body("wheel", RigidBody{kMass, Vector3d::Zero(), kInertia * Eigen::Matrix3d::Identity()},
             pose, sign * lead * rate_rad_s * kAxis, sign * rate_rad_s * kAxis);
  const std::size_t ground = build.marker("ground.hub", 0);
  const std::size_t hub = build.marker("wheel.hub", 1);
  build.joint("hub", &kind, outwards ? ground : hub, outwards ? hub : ground, kAxis);
  build.model.joints[0].lead_m = kind.advances ? kLead : 0;
  build.model.joints[0].start_angle_rad = angle_rad;
  build.model.angles.push_back({"turn", hub, ground, kAxis, sign * angle_rad});
  build.model.gravity_m_s2.setZero();
  return build.model;
}

JointResistance coil() {
  JointResistance spring{"coil", 0, JointCoordinate::angle, {}};
  for (ResistanceSide* side : {&spring.resistance.positive, &spring.resistance.negative})
    side->curve = LoadCurve::cubic(kStiffness);
  return spring;
}

double frequency_rad_s(const JointKind& kind) {
  const double lead = kind.advances ? kLead / kTurn : 0;
  return std::sqrt(kStiffness / (kInertia + kMass * lead * lead));
}

}  // namespace

TEST_CASE("a coil spring on a joint's angle winds up over turns, as its closed form does") {
  const JointKind* const kind =
      GENERATE(&kRevoluteJoint, &kCylindricalJoint, &kScrewJoint, &kPlanarJoint);
  const bool outwards = GENERATE(true, false);
  const double start = GENERATE(0., 1.2 * kTurn);
  const auto integrator = GENERATE(Integrator::dormand_prince, Integrator::generalised_alpha);
  SolverOptions solver = solver_of(1e-7, 1e-10);
  solver.integrator = integrator;
  INFO(kind->name << (outwards ? "" : ", reversed") << ", from " << start);
  constexpr double kRate = 14;
  Model model = wheel(*kind, start, kRate, outwards);
  model.forces.add(coil());
  // Outputs are further apart than half a turn.
  const History history = simulate(model, solver, {.end_time_s = 3, .interval_s = 0.75});
  const double omega = frequency_rad_s(*kind);
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const double t = history.time_s[k];
    const double angle = start * std::cos(omega * t) + kRate / omega * std::sin(omega * t);
    const double tolerance = integrator == Integrator::dormand_prince ? 1e-5 : 3e-3;
    CHECK(history.energy.strain_J[k] ==
          Approx(0.5 * kStiffness * angle * angle).margin(30 * tolerance));
    CHECK(history.angles[0].angle_rad[k] == Approx(outwards ? angle : -angle).margin(tolerance));
  }
}

TEST_CASE("a measured angle counts each turn between coarse outputs, at any rate") {
  const auto integrator = GENERATE(Integrator::dormand_prince, Integrator::generalised_alpha);
  SolverOptions solver = solver_of(1e-5, 1e-8);
  solver.integrator = integrator;
  solver.max_step_s = 0.25;
  const double rate = GENERATE(330., -2500.);
  // With the spin alone steps grow to many turns; a torque changes the rate.
  Model model = wheel(kRevoluteJoint, 0, rate);
  const bool drives = GENERATE(false, true);
  if (drives) model.forces.add(Torque{"drive", 1, kAxis, constant_table(40)});
  const History history = simulate(model, solver, {.end_time_s = 1, .interval_s = 0.5});
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const double t = history.time_s[k];
    const double angle = rate * t + (drives ? 0.5 * 40 / kInertia * t * t : 0);
    CHECK(history.angles[0].angle_rad[k] == Approx(angle).margin(1e-2));
  }
}

TEST_CASE("a quasi-static ramp winds a coil spring by more than half a turn an output") {
  const SolverOptions solver = solver_of(1e-9, 1e-12);
  const double start = GENERATE(0., 1.2 * kTurn);
  Model model = wheel(kRevoluteJoint, start, 0);
  model.forces.add(coil());
  constexpr double kLargest = 5 * kTurn;
  model.forces.add(
      Torque{"wind", 1, kAxis,
             TimeTable({0, 1}, {0, kStiffness * kLargest}, TimeTable::Outside::constant)});
  const History history = settle(model, solver, {.end_time_s = 1, .interval_s = 0.25});
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const double angle = kLargest * history.time_s[k];
    CHECK(history.angles[0].angle_rad[k] == Approx(angle).margin(1e-8));
    CHECK(history.energy.strain_J[k] == Approx(0.5 * kStiffness * angle * angle).margin(1e-6));
  }
}

TEST_CASE("an equilibrium is found turns away from the start, and the run goes on from there") {
  SolverOptions solver = solver_of(1e-9, 1e-12);
  Model model = wheel(kRevoluteJoint, 0, 0);
  model.forces.add(coil());
  constexpr double kAngle = 2.3 * kTurn;
  model.forces.add(Torque{"wind", 1, kAxis, constant_table(kStiffness * kAngle)});
  const History history =
      simulate_from_equilibrium(model, solver, {.end_time_s = 1, .interval_s = 0.5});
  const Eigen::VectorXd strain = history.energy.strain_J;
  CHECK(strain.minCoeff() == Approx(0.5 * kStiffness * kAngle * kAngle).epsilon(1e-9));
  CHECK(history.energy.kinetic_J.maxCoeff() < 1e-12);
}

TEST_CASE("a stepped run keeps its turns where inputs change and where it is restored") {
  const SolverOptions solver = solver_of(1e-9, 1e-12);
  Model model = wheel(kRevoluteJoint, 0, 14);
  model.forces.add(coil());
  model.forces.add(Torque{"push", 1, kAxis, constant_table(0)});
  const double omega = frequency_rad_s(kRevoluteJoint);
  constexpr double kPush = 3;  // N m from 0.5 s on
  const auto angle = [&](double t) {
    const double before = 14 / omega * std::sin(omega * t);
    return t < 0.5 ? before : before + kPush / kStiffness * (1 - std::cos(omega * (t - 0.5)));
  };
  SteppedRun run(model, solver, SteppedRun::Kind::motion);
  const auto inputs = inputs_of(model);
  std::size_t push = 0;
  while (inputs[push].name != "torque.push.magnitude") ++push;
  run.advance(0.5);
  run.set_input(push, kPush);
  run.advance(0.8);
  const SteppedRun::State saved = run.state();
  SteppedRun other(model, solver, SteppedRun::Kind::motion);
  other.restore(saved);
  for (const double end : {1.2, 3.0}) {
    run.advance(end);
    other.advance(end);
    CHECK(run.state().y == other.state().y);
    const History output = other.output();
    CHECK(output.angles[0].angle_rad == run.output().angles[0].angle_rad);
    CHECK(output.angles[0].angle_rad[0] == Approx(angle(end)).margin(1e-6));
    CHECK(output.energy.strain_J[0] ==
          Approx(0.5 * kStiffness * angle(end) * angle(end)).margin(1e-4));
  }
}
