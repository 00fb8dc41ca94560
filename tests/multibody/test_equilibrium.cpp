// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/descriptor/equilibrium.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/point_mass_body.h"

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;
using flexneck::testing::make_point_mass_body;
using namespace flexneck::multibody;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;

namespace {

constexpr double kLength = 0.4;

Quaterniond about_y(double angle) {
  return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
}

/// A rod on a revolute joint at the origin, with its centre of mass half its length below when the
/// angle is zero.
Model pendulum(double angle) {
  Model model;
  model.gravity_m_s2 = {0, 0, -9.81};
  RigidBody rod;
  rod.mass_kg = 2;
  rod.center_m = {0, 0, -kLength / 2};
  rod.inertia_kg_m2 = Vector3d(0.03, 0.02, 0.015).asDiagonal();
  model.bodies.push_back({"ground", PrescribedBody{}, {}});
  model.bodies.push_back({"rod", rod, {Vector3d::Zero(), about_y(angle)}});
  model.markers = {{"pivot", 0, ""}, {"top", 1, ""}};
  Marker bottom{"bottom", 1, ""};
  bottom.position_m = {0, 0, -kLength};
  model.markers.push_back(bottom);
  model.joints.push_back({"pin", &kRevoluteJoint, 0, 1});
  return model;
}

VectorXd equilibrium_of(const Model& model) {
  const System system(model);
  EquationsOfMotion held(system, Drive::held);
  return equilibrium_positions(model, held);
}

}  // namespace

TEST_CASE("a pendulum comes to hang from wherever it starts") {
  // The stiffness almost vanishes at 1.5708, and 3.1 is close to the upper, unstable equilibrium.
  for (const double angle : {0.0, 0.3, -1.2, std::numbers::pi / 2, 2.0, 3.1}) {
    CAPTURE(angle);
    const VectorXd Q = equilibrium_of(pendulum(angle));
    const Quaterniond q(Q[3], Q[4], Q[5], Q[6]);
    CHECK((q * -Vector3d::UnitZ() + Vector3d::UnitZ()).norm() < 1e-10);
  }
}

TEST_CASE("a side force holds a pendulum where the moments balance, from wherever it starts") {
  // The search for the least energy finds the stable one of the two collinear equilibria.
  const double start = GENERATE(0.0, -1.2, 2.0, -2.0, 3.1, -2.9);
  CAPTURE(start);
  Model model = pendulum(start);
  model.forces.add(PointForce{"pull", 2, Vector3d::UnitX(),
                              TimeTable({0, 1}, {5, 50}, TimeTable::Outside::constant)});
  const VectorXd Q = equilibrium_of(model);
  const Quaterniond q(Q[3], Q[4], Q[5], Q[6]);
  const Vector3d down = q * -Vector3d::UnitZ();
  // m g (L / 2) sin(angle) = F L cos(angle), with the force at time zero.
  CHECK(down.x() / -down.z() == Approx(5 * kLength / (2 * 9.81 * kLength / 2)).epsilon(1e-10));
  CHECK(down.z() < 0);
}

TEST_CASE("a modal body sags until elastic and gravity forces balance") {
  Model model;
  model.gravity_m_s2 = {2, 3, -9.81};
  const auto body = make_point_mass_body(51, 3).body;
  model.bodies.push_back({"ground", PrescribedBody{}, {}});
  model.bodies.push_back({"flexible", DeformableBody{body, VectorXd::Constant(3, 0.1)}, {}});
  model.markers = {{"wall", 0, ""}, {"root", 1, "root"}};
  model.joints.push_back({"clamp", &kFixedJoint, 0, 1});
  const VectorXd Q = equilibrium_of(model);
  // The clamp fixes the body frame: omega^2 a = S2^T g, without approximation.
  for (int l = 0; l < 3; ++l) {
    const double omega = 2 * std::numbers::pi * body.frequencies_Hz[l];
    CHECK(
        Q[7 + l] ==
        Approx(body.invariants.S2.col(l).dot(model.gravity_m_s2) / (omega * omega)).epsilon(1e-10));
  }
}

TEST_CASE("a run from equilibrium stays there while nothing is driven") {
  Model model;
  model.gravity_m_s2 = {1, 2, -9.81};
  PrescribedBody sled;
  sled.initial_velocity_m_s = 3;
  model.bodies.push_back({"sled", sled, {}});
  const auto body = make_point_mass_body(52, 3).body;
  model.bodies.push_back({"flexible", DeformableBody{body, VectorXd::Constant(3, 0.1)}, {}});
  RigidBody head;
  head.mass_kg = 3;
  head.center_m = {0.02, 0.01, 0.05};
  head.inertia_kg_m2 = Vector3d(0.016, 0.024, 0.022).asDiagonal();
  model.bodies.push_back({"head", head, {body.interface("tip").position_m}});
  model.markers = {{"sled", 0, ""}, {"root", 1, "root"}, {"tip", 1, "tip"}, {"head", 2, ""}};
  model.joints = {{"base", &kFixedJoint, 0, 1}, {"top", &kFixedJoint, 2, 3}};
  OutputOptions output;
  output.end_time_s = 0.3;
  output.interval_s = 0.1;
  const History history = simulate_from_equilibrium(model, SolverOptions{}, output);
  const auto& modal = history.modal[0].coordinates;
  // The head's weight bends this soft body visibly.
  REQUIRE(modal.col(0).norm() > 1e-3);
  CHECK((modal.col(3) - modal.col(0)).norm() < 1e-9);
  const MarkerHistory& tip = history.marker("tip");
  CHECK((tip.velocity_m_s.col(3) - Vector3d(3, 0, 0)).norm() < 1e-8);
  CHECK((tip.position_m.col(3) - tip.position_m.col(0) - Vector3d(0.9, 0, 0)).norm() < 1e-9);
  // Each joint carries the weight below it.
  const double mass = 3 + body.invariants.mass;
  CHECK((history.joint("base").force_N.col(3) + mass * model.gravity_m_s2).norm() < 1e-6);
}

TEST_CASE("a quasi-static ramp is a row of equilibria, in closed form, with the work it takes") {
  // A pendulum pulled sideways at its end: tan(angle) = 2 F / (m g).
  Model model = pendulum(0);
  constexpr double kLargest_N = 60;
  model.forces.add(PointForce{"pull", 2, Vector3d::UnitX(),
                              TimeTable({0, 1}, {0, kLargest_N}, TimeTable::Outside::constant)});
  SolverOptions solver;
  solver.formulation = GENERATE(Formulation::descriptor, Formulation::recursive);
  const History history = settle(model, solver, {.end_time_s = 1, .interval_s = 0.125});
  const double weight = 2 * 9.81;
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const double pull = kLargest_N * history.time_s[k];
    const double angle = std::atan2(2 * pull, weight);
    const Vector3d expected = kLength * Vector3d(std::sin(angle), 0, -std::cos(angle));
    CHECK((history.marker("bottom").position_m.col(k) - expected).norm() < 1e-9);
    CHECK(history.marker("bottom").velocity_m_s.col(k).norm() == 0);
    CHECK(history.joint("pin").force_N.col(k).norm() ==
          Approx(std::hypot(weight, pull)).epsilon(1e-9));
    CHECK(history.energy.work_J[k] ==
          Approx(weight * kLength / 2 * (1 - std::cos(angle))).margin(1e-9));
  }
}

TEST_CASE("a quasi-static ramp carries bodies along with what is driven") {
  Model model = pendulum(0);
  PrescribedBody hoist;
  hoist.initial_velocity_m_s = 0.5;
  model.bodies[0].kind = hoist;
  SolverOptions solver;
  solver.formulation = GENERATE(Formulation::descriptor, Formulation::recursive);
  const History history = settle(model, solver, {.end_time_s = 2, .interval_s = 1});
  // It is carried by one metre and hangs straight: it does not swing, however fast the carrier.
  CHECK((history.marker("bottom").position_m.col(2) - Vector3d(1, 0, -kLength)).norm() < 1e-9);
}

TEST_CASE("a quasi-static ramp ends where nothing holds any more, and keeps what was before") {
  Model model = pendulum(0);
  model.gravity_m_s2.setZero();
  model.joints[0].kind = &kPrismaticJoint;
  model.joints[0].axis = Vector3d::UnitX();
  model.forces.add(PointForce{"pull", 2, Vector3d::UnitX(),
                              TimeTable({0, 0.5, 1}, {0, 0, 5}, TimeTable::Outside::constant)});
  try {
    settle(model, {}, {.end_time_s = 1, .interval_s = 0.1});
    FAIL("a block that nothing holds was found at rest");
  } catch (const IncompleteRun& run) {
    CHECK_THAT(run.what(), Contains("no static equilibrium") && Contains("at 0.6"));
    CHECK(run.history.time_s.size() == 6);
    CHECK(run.history.incomplete == run.what());
  }
}

namespace {

/// Von Mises' truss: a block on a vertical slide, pushed down against a spring that is fixed beside
/// it and is horizontal halfway.
Model truss(const TimeTable& push_N) {
  Model model = pendulum(0);
  model.gravity_m_s2.setZero();
  model.joints[0].kind = &kPrismaticJoint;
  model.joints[0].axis = Vector3d::UnitZ();
  Marker foot{"foot", 0, ""};
  foot.position_m = {0.4, 0, -0.1};
  model.markers.push_back(foot);
  MarkerSpring spring;
  spring.name = "spring";
  spring.marker_i = 3;
  spring.marker_j = 1;
  spring.free_length_m = std::hypot(0.4, 0.1);
  spring.resistance.positive.curve = spring.resistance.negative.curve = LoadCurve::cubic(1e5, 0, 0);
  model.forces.add(std::move(spring));
  model.forces.add(PointForce{"push", 1, -Vector3d::UnitZ(), push_N});
  return model;
}

}  // namespace

TEST_CASE("a quasi-static ramp tells a snap-through, and no other motion, however quick") {
  using Outside = TimeTable::Outside;
  SolverOptions solver;
  solver.formulation = GENERATE(Formulation::descriptor, Formulation::recursive);
  const auto warnings = [&](const Model& model, double interval_s) {
    return settle(model, solver, {.end_time_s = 1, .interval_s = interval_s}).warnings;
  };
  // With the spring's height z its force upwards is k (L0 / l - 1) z, l^2 = b^2 + z^2, which is
  // largest at l^3 = L0 b^2.
  constexpr double kRamp_N = 200;
  const double free = std::hypot(0.4, 0.1);
  const double length = std::cbrt(free * 0.4 * 0.4);
  const double height = std::sqrt(length * length - 0.4 * 0.4);
  const double snap_s = 1e5 * (free / length - 1) * height / kRamp_N;
  REQUIRE(snap_s < 0.9);
  for (const double interval_s : {0.5, 0.1, 0.01}) {
    CAPTURE(interval_s);
    const auto told =
        warnings(truss(TimeTable({0, 1}, {0, kRamp_N}, Outside::constant)), interval_s);
    REQUIRE(told.size() == 1);
    CHECK_THAT(told[0], StartsWith("the equilibrium jumps at ") && Contains("' moves by "));
    const double at_s = std::stod(told[0].substr(std::string("the equilibrium jumps at ").size()));
    CHECK(at_s == Approx(snap_s).margin(2e-3 * interval_s));
  }
  const auto there_and_back =
      warnings(truss(TimeTable({0, 0.5, 1}, {0, kRamp_N, -kRamp_N}, Outside::constant)), 0.01);
  REQUIRE(there_and_back.size() == 1);
  CHECK_THAT(there_and_back[0], Contains("the first of 2 jumps"));
  // No jump before the snap-through, when pulled, with a load that jumps itself, and after a kink.
  CHECK(warnings(truss(TimeTable({0, 1}, {0, 0.99 * snap_s * kRamp_N}, Outside::constant)), 0.1)
            .empty());
  CHECK(warnings(truss(TimeTable({0, 1}, {0, -kRamp_N}, Outside::constant)), 0.1).empty());
  CHECK(warnings(truss(TimeTable({0, 0.55, 0.550001, 1}, {0, 0, -50, -50}, Outside::constant)), 0.1)
            .empty());
  CHECK(warnings(truss(TimeTable({0, 0.55, 1}, {0, 0, -500}, Outside::constant)), 0.1).empty());
  CHECK(warnings(truss(TimeTable({0, 1}, {0, 0}, Outside::constant)), 0.1).empty());
}

TEST_CASE("what has no equilibrium is refused") {
  Model loose = pendulum(0);
  loose.joints.clear();
  CHECK_THROWS_WITH(equilibrium_of(loose), Contains("rod") && Contains("no equilibrium"));

  Model torn = pendulum(0);
  PrescribedBody sled;
  sled.initial_velocity_m_s = 1;
  torn.bodies.push_back({"sled", sled, {{0, 0, -kLength}}});
  torn.markers.push_back({"on sled", 2, ""});
  torn.joints.push_back({"hook", &kSphericalJoint, 3, 2});
  CHECK_THROWS_AS(equilibrium_of(torn), flexneck::InputError);
}
