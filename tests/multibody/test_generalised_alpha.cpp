// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "multibody/time/generalised_alpha.h"
#include "tests/support/formulations.h"
#include "tests/support/piecewise_motion.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Catch::Matchers::Contains;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

std::unique_ptr<Equations> equations_of(const Model& model, Formulation formulation) {
  SolverOptions solver;
  // Newton's method continues to a hundredth of this.
  solver.relative_tolerance = 1e-10;
  solver.absolute_tolerance = 1e-12;
  return formulation == Formulation::recursive ? recursive_equations(model, solver)
                                               : descriptor_equations(model, solver);
}

/// The state at `end_s` after equal steps.
VectorXd end_of(const Model& model, Formulation formulation, double spectral_radius, double end_s,
                int steps) {
  const auto equations = equations_of(model, formulation);
  equations->set_interval(0, 2 * end_s);
  GeneralisedAlpha integrator(*equations, spectral_radius, {1, 1e-10}, 0, equations->given_state());
  for (int k = 0; k < steps; ++k) integrator.fixed_step(end_s / steps);
  return integrator.state();
}

/// The heavy top of Bruels, Cardona and Arnold.
Model heavy_top() {
  ModelBuilder build;
  RigidBody body;
  body.mass_kg = 15;
  body.center_m = {0, 1, 0};
  body.inertia_kg_m2 = Vector3d(0.234375, 0.46875, 0.234375).asDiagonal();
  const auto ground = build.ground();
  const auto top = build.body("top", body, {}, Vector3d::Zero(), {0, 150, -4.61538});
  build.joint("ball", &kSphericalJoint, build.marker("pivot", ground), build.marker("tip", top));
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  return build.model;
}

Vector3d top_center(const VectorXd& state, Formulation formulation) {
  // Descriptor: x, quaternion; recursive: quaternion alone.
  const bool descriptor = formulation == Formulation::descriptor;
  const Vector3d origin = descriptor ? Vector3d(state.head<3>()) : Vector3d::Zero();
  const auto q = state.segment<4>(descriptor ? 3 : 0);
  return origin + Quaterniond(q[0], q[1], q[2], q[3]) * Vector3d(0, 1, 0);
}

/// A pendulum on a revolute joint: a stiff beam without damping and a head.
Model stiff_pendulum() {
  ModelBuilder build;
  Beam beam;
  beam.length_m = 0.5;
  beam.fore_aft_Hz = beam.lateral_Hz = 800;
  const Quaterniond tilt(Eigen::AngleAxisd(2.0, Vector3d::UnitY()));
  const auto ground = build.ground();
  const auto bar = build.body("bar", deformable(make_beam_body(beam), 0), {Vector3d::Zero(), tilt});
  const auto head = build.body("head", make_head(), {tilt * Vector3d(0, 0, beam.length_m), tilt});
  build.joint("pin", &kRevoluteJoint, build.marker("pivot", ground, Vector3d::Zero(), tilt),
              build.interface_marker("root", bar, "base"));
  build.joint("weld", &kFixedJoint, build.interface_marker("top", bar, "top"),
              build.marker("head", head));
  build.marker("head cg", head, make_head().center_m);
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  return build.model;
}

/// Rods of 1 kg on revolute joints, released at rest far from the vertical.
Model hanging_rods(int count, double length, double inertia, const Vector3d& from) {
  ModelBuilder build;
  const Quaterniond tilt(Eigen::AngleAxisd(-1.2, Vector3d::UnitY()));
  Vector3d at = from;
  auto before = build.marker("ground", build.ground(), at);
  for (int k = 0; k < count; ++k) {
    const std::string name = std::to_string(k);
    const RigidBody rod{1, {0, 0, -length / 2}, inertia * Eigen::Matrix3d::Identity()};
    const auto body = build.body("rod " + name, rod, {at, tilt});
    build.joint("pin " + name, &kRevoluteJoint, before, build.marker("top " + name, body));
    before = build.marker("end " + name, body, {0, 0, -length});
    at += tilt * Vector3d(0, 0, -length);
  }
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  return build.model;
}

constexpr double kCrankRate = 3;
constexpr double kCrankStart = -1.5;

/// Bars of 1 kg: cranks of 1 m at both ends of a coupler of 2 m, which rotate equally and evenly.
/// The mechanism is flat, where its rows are dependent, whenever the cranks pass a multiple of pi:
/// first at 0.5 s.
Model parallelogram(double inertia) {
  ModelBuilder build;
  const auto bar = [&](double length) {
    return RigidBody{1, {length / 2, 0, 0}, inertia * Eigen::Matrix3d::Identity()};
  };
  const Quaterniond turn(Eigen::AngleAxisd(-kCrankStart, Vector3d::UnitY()));
  const Vector3d crank = turn * Vector3d::UnitX();
  const Vector3d rate(0, -kCrankRate, 0);
  const Vector3d across(2, 0, 0);
  const auto ground = build.ground();
  const auto left = build.body("left", bar(1), {Vector3d::Zero(), turn}, Vector3d::Zero(), rate);
  const auto coupler = build.body("coupler", bar(2), {crank}, rate.cross(crank));
  const auto right = build.body("right", bar(1), {across, turn}, Vector3d::Zero(), rate);
  build.joint("A", &kRevoluteJoint, build.marker("a", ground), build.marker("left a", left));
  build.joint("B", &kRevoluteJoint, build.marker("left b", left, {1, 0, 0}),
              build.marker("b", coupler));
  build.joint("C", &kRevoluteJoint, build.marker("c", coupler, across),
              build.marker("right c", right, {1, 0, 0}));
  build.joint("D", &kRevoluteJoint, build.marker("d", ground, across),
              build.marker("right d", right));
  return build.model;
}

}  // namespace

TEST_CASE("generalised-alpha takes the heavy top where it must be, with order two") {
  const Formulation formulation = either_formulation();
  const Model model = heavy_top();
  const Vector3d published(-0.15041682, -0.72416559, -0.67302227);
  const auto end = [&](int steps) {
    return top_center(end_of(model, formulation, 0.9, 2, steps), formulation);
  };
  // It spins by 150 rad/s: 13 and 6.5 steps a radian.
  const Vector3d coarse = end(4000);
  const Vector3d fine = end(8000);
  const double error = (fine - published).norm();
  CHECK(std::log2((coarse - published).norm() / error) == Approx(2).margin(0.05));
  // Extrapolation removes the leading term of the error and leaves those of higher order.
  CHECK(((4 * fine - coarse) / 3 - published).norm() < error / 20);
}

TEST_CASE("generalised-alpha is of order two for deformation, whatever it damps") {
  const double spectral_radius = GENERATE(0.0, 0.7, 1.0);
  const TimeTable pull({0, 1}, {-150, -150}, TimeTable::Outside::constant);
  ModelBuilder build = head_on_neck({Vector3d(1, 1, 0).normalized(), 3, pull}, hanging_pose(),
                                    Beam{}, 0.4, make_head());
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  constexpr double kEnd_s = 0.04;
  const SolverOptions tight{.relative_tolerance = 1e-12, .absolute_tolerance = 1e-15};
  const History exact = simulate(build.model, tight, {.end_time_s = kEnd_s, .interval_s = kEnd_s});
  const VectorXd reference = exact.modal[0].coordinates.col(1);
  // A fixed joint has no coordinates; the state begins with the modes.
  const auto error = [&](int steps) {
    return (end_of(build.model, Formulation::recursive, spectral_radius, kEnd_s, steps).head(4) -
            reference)
        .norm();
  };
  const double coarse = error(200);
  const double fine = error(400);
  CHECK(std::log2(coarse / fine) == Approx(2).margin(0.1));
  CHECK(fine < 1e-3 * reference.norm());
}

TEST_CASE("the local error of generalised-alpha is that of its formulas on a cubic path") {
  const double radius = GENERATE(0.0, 0.5, 0.8, 1.0);
  const AlphaParameters alpha(radius);
  // x'' = t: the auxiliary a is x'' at t_n + shift h, so that a step from rest is in closed form.
  constexpr double kStep = 0.1;
  const double a = alpha.shift * kStep;
  const double a_next = ((1 - alpha.alpha_f) * kStep - alpha.alpha_m * a) / (1 - alpha.alpha_m);
  CHECK(a_next == Approx(kStep + a));
  const double x = kStep * kStep * ((0.5 - alpha.beta) * a + alpha.beta * a_next);
  const double exact = kStep * kStep * kStep / 6;
  CHECK(x - exact == Approx(alpha.error * kStep * kStep * kStep).epsilon(1e-12));
}

TEST_CASE("generalised-alpha steps over stiff vibrations that hold up the explicit method") {
  const Formulation formulation = either_formulation();
  const Model model = stiff_pendulum();
  const OutputOptions output{.end_time_s = 0.2, .interval_s = 0.02};
  SolverOptions solver{.relative_tolerance = 1e-5, .absolute_tolerance = 1e-8};
  solver.formulation = formulation;
  const History exact = simulate(model, solver, output);
  solver.integrator = Integrator::generalised_alpha;
  const History found = simulate(model, solver, output);
  CHECK(10 * found.statistics.evaluations < exact.statistics.evaluations);
  // A local error of 1e-5 a step adds up over about 100.
  const MarkerHistory& a = exact.marker("head cg");
  const MarkerHistory& b = found.marker("head cg");
  CHECK((a.position_m - b.position_m).colwise().norm().maxCoeff() < 1e-3);
  CHECK(b.position_m.col(0) != b.position_m.col(10));
  // Outputs satisfy the joints.
  CHECK(found.statistics.max_position_residual < 1e-9);
  // Each run reports what limits its steps.
  REQUIRE_FALSE(exact.statistics.limits.empty());
  REQUIRE_FALSE(found.statistics.limits.empty());
  int steps = 0;
  for (const StepLimit& limit : found.statistics.limits) steps += limit.steps;
  CHECK(steps == found.statistics.accepted);
  CHECK_THAT(exact.statistics.limits.front().what,
             Contains("deformation of body 'bar'") || Contains("velocity of body"));
}

TEST_CASE("generalised-alpha keeps the books of energy, damped and not, in closed form") {
  // A block on a prismatic joint between a spring with a damper and a constant force.
  constexpr double kMass_kg = 2;
  constexpr double kStiffness = 800;  // N/m: 20 rad/s
  constexpr double kForce_N = 40;
  constexpr double kFree_m = 1;     // length of the spring
  constexpr double kStart_m = 0.1;  // beyond it
  const double zeta = GENERATE(0.0, 0.1);
  const double omega = std::sqrt(kStiffness / kMass_kg);
  ModelBuilder build;
  const auto ground = build.ground();
  const auto block =
      build.body("block", RigidBody{kMass_kg, Vector3d::Zero(), Matrix3d::Identity()},
                 {{kFree_m + kStart_m, 0, 0}});
  const auto wall = build.marker("wall", ground);
  const auto hook = build.marker("hook", block);
  build.joint("rail", &kPrismaticJoint, wall, hook, Vector3d::UnitX());
  Resistance stretch;
  stretch.positive.curve = stretch.negative.curve = LoadCurve::cubic(kStiffness);
  stretch.damping = 2 * zeta * omega * kMass_kg;
  build.model.forces.add(MarkerSpring{"spring", wall, hook, kFree_m, stretch});
  build.force("push", hook, Vector3d::UnitX(), constant_table(kForce_N));
  SolverOptions solver = solver_of(1e-9, 1e-12);
  solver.integrator = Integrator::generalised_alpha;
  const History history = simulate(build.model, solver, {.end_time_s = 0.5, .interval_s = 0.05});
  // It oscillates freely about its rest: x - rest = offset e^(-zeta omega t) (cos + sin zeta / ..).
  const double rest = kForce_N / kStiffness;
  const double offset = kStart_m - rest;
  const double damped = omega * std::sqrt(1 - zeta * zeta);
  const double whole_J = 0.5 * kStiffness * kStart_m * kStart_m;
  const double tolerance_J = 1e-4 * whole_J;
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const double t = history.time_s[k];
    const double decay = offset * std::exp(-zeta * omega * t);
    const double x =
        rest + decay * (std::cos(damped * t) + zeta * omega / damped * std::sin(damped * t));
    const double v = -decay * omega * omega / damped * std::sin(damped * t);
    const double kinetic_J = 0.5 * kMass_kg * v * v;
    const double strain_J = 0.5 * kStiffness * x * x;
    const double work_J = kForce_N * (x - kStart_m);
    CAPTURE(zeta, t);
    CHECK(history.energy.kinetic_J[k] == Approx(kinetic_J).margin(tolerance_J));
    CHECK(history.energy.strain_J[k] == Approx(strain_J).margin(tolerance_J));
    CHECK(history.energy.work_J[k] == Approx(work_J).margin(tolerance_J));
    CHECK(history.energy.dissipated_J[k] ==
          Approx(whole_J + work_J - kinetic_J - strain_J).margin(tolerance_J));
  }
}

TEST_CASE("generalised-alpha does not step over a short contact") {
  // A flight that grazes its stop by 0.2 mm: accelerations are the same on both sides of it.
  constexpr double kPush_N = -9.174;
  constexpr double kSpeed_m_s = 0.972491;
  constexpr double kStop_m = 0.0513513;
  constexpr double kStiffness = 9251;
  constexpr double kEnd_s = 0.6;
  ModelBuilder build;
  const auto wall = build.marker("wall", build.ground());
  const auto block = build.body("block", RigidBody{1, Vector3d::Zero(), Matrix3d::Identity()}, {},
                                Vector3d(kSpeed_m_s, 0, 0));
  const auto hook = build.marker("hook", block);
  build.joint("rail", &kPrismaticJoint, wall, hook, Vector3d::UnitX());
  JointResistance law{"stop", 0, JointCoordinate::distance, {}};
  law.resistance.positive.stop = kStop_m;
  law.resistance.positive.beyond_stop = LoadCurve::cubic(kStiffness);
  build.model.forces.add(law);
  build.force("push", hook, Vector3d::UnitX(), constant_table(kPush_N));
  PiecewiseMotion motion(kPush_N, {{kStop_m, 1, kStiffness}}, 0, kSpeed_m_s);
  motion.advance(kEnd_s);
  SolverOptions solver = solver_of(1e-7, 1e-10);
  solver.integrator = Integrator::generalised_alpha;
  for (const Formulation formulation : {Formulation::recursive, Formulation::descriptor})
    for (const double largest_s : {1e-2, 1.0}) {
      CAPTURE(formulation == Formulation::recursive, largest_s);
      solver.formulation = formulation;
      solver.max_step_s = largest_s;
      const History history =
          simulate(build.model, solver, {.end_time_s = kEnd_s, .interval_s = kEnd_s});
      CHECK(history.marker("hook").position_m(0, 1) == Approx(motion.x()).margin(1e-4));
    }
}

TEST_CASE("generalised-alpha closes loops whose joints repeat each other") {
  // A door on two hinges of one axis.
  ModelBuilder build;
  const auto ground = build.ground();
  const auto door =
      build.body("door", RigidBody{10, {0.4, 0, 0}, Vector3d(0.5, 0.9, 0.6).asDiagonal()});
  for (const double z : {0.0, 1.0}) {
    const std::string name = "hinge " + std::to_string(z);
    build.joint(name, &kRevoluteJoint, build.marker("frame " + name, ground, {0, 0, z}),
                build.marker("door " + name, door, {0, 0, z}), Vector3d::UnitZ());
  }
  build.marker("edge", door, {0.8, 0, 0});
  build.model.gravity_m_s2 = {0.5, 2, -kGravity};
  const OutputOptions output{.end_time_s = 0.5, .interval_s = 0.1};
  SolverOptions solver{.relative_tolerance = 1e-8, .absolute_tolerance = 1e-11};
  solver.formulation = Formulation::descriptor;
  const History exact = simulate(build.model, solver, output);
  solver.integrator = Integrator::generalised_alpha;
  const History found = simulate(build.model, solver, output);
  CHECK((exact.marker("edge").position_m - found.marker("edge").position_m).norm() < 1e-5);
  CHECK((exact.marker("edge").position_m.col(5) - exact.marker("edge").position_m.col(0)).norm() >
        0.1);
  CHECK(found.redundant_constraints.size() == 5);
}

TEST_CASE(
    "generalised-alpha starts at rest with short steps, whatever is left of the constraints") {
  // Over the first steps, some 1e-5 s long, rounding of the positions causes speeds of 1e-11 m/s
  // and more, a hundredth of the tolerance for bodies at rest.
  const Model model =
      GENERATE(hanging_rods(6, 1, 1e-2, {0, 0, 0}), hanging_rods(6, 0.1, 1e-6, {100, 0, 0}));
  const OutputOptions output{.end_time_s = 0.2, .interval_s = 0.2};
  const History exact =
      simulate(model, {.relative_tolerance = 1e-10, .absolute_tolerance = 1e-12}, output);
  SolverOptions solver{.relative_tolerance = GENERATE(1e-6, 1e-8), .absolute_tolerance = 1e-9};
  solver.formulation = Formulation::descriptor;
  solver.integrator = Integrator::generalised_alpha;
  const History found = simulate(model, solver, output);
  // The method is of order 2, with a local error of order 3.
  const double allowed = 0.5 * std::pow(solver.relative_tolerance, 2. / 3);
  CHECK((exact.marker("end 5").position_m - found.marker("end 5").position_m).norm() < allowed);
}

TEST_CASE("generalised-alpha passes through the flat positions of a parallelogram") {
  const double inertia = GENERATE(1e-1, 1e-6);
  const auto error = [&](double tolerance, double end_s) {
    SolverOptions solver{.relative_tolerance = tolerance, .absolute_tolerance = 1e-3 * tolerance};
    solver.formulation = Formulation::descriptor;
    solver.integrator = Integrator::generalised_alpha;
    // One output is in the flat position.
    const History history =
        simulate(parallelogram(inertia), solver, {.end_time_s = end_s, .interval_s = 0.5});
    double largest = 0;
    for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
      const double angle = kCrankStart + kCrankRate * history.time_s[k];
      const Vector3d expected(std::cos(angle), 0, std::sin(angle));
      largest = std::max(largest, (history.marker("b").position_m.col(k) - expected).norm());
    }
    return largest;
  };
  // The flat position is passed five times; there are some 300 steps at 1e-5, and the method is of
  // order 2: the error goes with the tolerance's power 2/3.
  const double coarse = error(1e-5, 5);
  CHECK(coarse < 3e-3);
  CHECK(error(1e-7, 5) < coarse / 10);
  // The output at 0.5 s is within 1e-6 of flat, where one more row is redundant, and only there.
  CHECK(error(1e-9, 1) < 2e-6);
}

TEST_CASE("a spectral radius out of its range is refused") {
  SolverOptions solver;
  solver.integrator = Integrator::generalised_alpha;
  solver.spectral_radius = 1.5;
  CHECK_THROWS_WITH(simulate(heavy_top(), solver, {}), Contains("spectral radius"));
}
