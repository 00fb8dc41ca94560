// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/history/recorder.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/point_mass_body.h"

using Eigen::Vector3d;
using Eigen::VectorXd;
using flexneck::InputError;
using flexneck::testing::make_point_mass_body;
using namespace flexneck::multibody;
using Catch::Matchers::Contains;

namespace {

/// A sled that brakes between 10 and 30 ms, with jumps at both ends, with a modal neck and a head.
Model sled() {
  Model model;
  model.gravity_m_s2 = {0, 0, -9.81};
  PrescribedBody base;
  base.initial_velocity_m_s = 4;
  base.acceleration_m_s2 = TimeTable({0.01, 0.03}, {-200, -150}, TimeTable::Outside::zero);
  model.bodies.push_back({"sled", base, {}});
  auto body = make_point_mass_body(81, 4).body;
  for (auto& interface : body.interfaces) interface.rotation *= 0.3;
  body.frequencies_Hz *= 5;
  model.bodies.push_back({"neck", DeformableBody{body, VectorXd::Constant(4, 0.4)}, {}, {4, 0, 0}});
  RigidBody head;
  head.mass_kg = 3;
  head.center_m = {0.02, 0.01, 0.05};
  head.inertia_kg_m2 = Vector3d(0.016, 0.024, 0.022).asDiagonal();
  model.bodies.push_back({"head", head, {body.interface("tip").position_m}, {4, 0, 0}});
  model.markers = {{"sled", 0, ""}, {"root", 1, "root"}, {"tip", 1, "tip"}, {"head", 2, ""}};
  Marker center{"head center", 2, ""};
  center.position_m = head.center_m;
  model.markers.push_back(center);
  model.joints = {{"base", &kFixedJoint, 0, 1}, {"top", &kFixedJoint, 2, 3}};
  return model;
}

SolverOptions tolerance(double relative) {
  SolverOptions options;
  options.relative_tolerance = relative;
  options.absolute_tolerance = 1e-3 * relative;
  return options;
}

const OutputOptions kShort{0.1, 2e-3};

}  // namespace

TEST_CASE("the energies of a braked sled balance to the tolerance") {
  for (const double relative : {1e-6, 1e-9}) {
    const History history = simulate(sled(), tolerance(relative), kShort);
    const EnergyHistory& e = history.energy;
    const VectorXd balance =
        e.kinetic_J + e.gravitational_J + e.strain_J + e.dissipated_J - e.work_J;
    const double drift = (balance.array() - balance[0]).abs().maxCoeff();
    // There are some hundred steps, each with an error of the tolerance's size.
    CHECK(drift < 10 * relative * e.kinetic_J.maxCoeff());
    CHECK(e.dissipated_J.tail(1)[0] > 1);
    CHECK(e.work_J.tail(1)[0] < -10);
    CHECK(history.statistics.max_position_residual < 1e-12);
    CHECK(history.statistics.max_velocity_residual < 1e-12);
  }
}

TEST_CASE("joints stay closed at every output time, to rounding") {
  // Positions of some decimetres, speeds of some metres a second.
  constexpr double kRounding = 1e-13;
  for (const Formulation formulation : {Formulation::descriptor, Formulation::recursive}) {
    SolverOptions solver = tolerance(1e-5);
    solver.formulation = formulation;
    const History history = simulate(sled(), solver, kShort);
    const ConstraintHistory& missed = history.constraints;
    for (const VectorXd* each : {&missed.position_m, &missed.orientation_rad, &missed.velocity_m_s,
                                 &missed.angular_velocity_rad_s}) {
      REQUIRE(each->size() == history.time_s.size());
      CHECK(each->maxCoeff() < 10 * kRounding);
    }
    CHECK((missed.position_m.maxCoeff() > 0) == (formulation == Formulation::descriptor));
    // Residuals by the motion of the markers alone, in either form.
    for (const auto& [i, j] : {std::pair{"sled", "root"}, std::pair{"tip", "head"}}) {
      const MarkerHistory& lower = history.marker(i);
      const MarkerHistory& upper = history.marker(j);
      CHECK((lower.position_m - upper.position_m).cwiseAbs().maxCoeff() < kRounding);
      CHECK((lower.velocity_m_s - upper.velocity_m_s).cwiseAbs().maxCoeff() < 10 * kRounding);
      CHECK((lower.rotation - upper.rotation).cwiseAbs().maxCoeff() < kRounding);
      CHECK((lower.angular_velocity_rad_s - upper.angular_velocity_rad_s).cwiseAbs().maxCoeff() <
            100 * kRounding);
    }
  }
}

TEST_CASE("a run converges with its tolerance, jumps of the drive included") {
  const History fine = simulate(sled(), tolerance(1e-11), kShort);
  const auto& reference = fine.marker("head center");
  for (const double relative : {1e-5, 1e-7, 1e-9}) {
    const History coarse = simulate(sled(), tolerance(relative), kShort);
    const auto& head = coarse.marker("head center");
    CHECK((head.position_m - reference.position_m).cwiseAbs().maxCoeff() < 10 * relative * 0.2);
    CHECK((head.velocity_m_s - reference.velocity_m_s).cwiseAbs().maxCoeff() < 20 * relative * 4);
  }
}

TEST_CASE("accelerations and reactions in a history obey Newton's law for the head") {
  const History history = simulate(sled(), tolerance(1e-8), kShort);
  const auto& head = history.marker("head center");
  const auto& tip = history.marker("tip");
  const auto& top = history.joint("top");
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    const Eigen::Quaterniond R(tip.rotation(0, k), tip.rotation(1, k), tip.rotation(2, k),
                               tip.rotation(3, k));
    const Vector3d force = R * top.force_N.col(k) + 3 * Vector3d(0, 0, -9.81);
    CHECK((force - 3 * head.acceleration_m_s2.col(k)).norm() < 1e-9 * (1 + force.norm()));
  }
}

TEST_CASE("a run does not depend on where the world has its origin") {
  Model moved = sled();
  const Vector3d shift(1000, -2000, 500);
  for (Body& body : moved.bodies) body.initial_pose.position_m += shift;
  const History here = simulate(sled(), tolerance(1e-6), kShort);
  const History there = simulate(moved, tolerance(1e-6), kShort);
  CHECK(here.statistics.accepted == there.statistics.accepted);
  const auto difference =
      (there.marker("head").position_m.colwise() - shift) - here.marker("head").position_m;
  CHECK(difference.cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("outputs are the multiples of the interval and the end") {
  const History even = simulate(sled(), tolerance(1e-6), {0.03, 0.01});
  REQUIRE(even.time_s.size() == 4);
  CHECK(even.time_s[3] == 0.03);
  const History odd = simulate(sled(), tolerance(1e-6), {0.025, 0.01});
  REQUIRE(odd.time_s.size() == 4);
  CHECK(odd.time_s[2] == 0.02);
  CHECK(odd.time_s[3] == 0.025);
}

TEST_CASE("the same run gives the same bits") {
  const History one = simulate(sled(), tolerance(1e-6), kShort);
  const History two = simulate(sled(), tolerance(1e-6), kShort);
  CHECK(one.marker("head").position_m == two.marker("head").position_m);
  CHECK(one.joint("base").moment_Nm == two.joint("base").moment_Nm);
  CHECK(one.energy.dissipated_J == two.energy.dissipated_J);
}

TEST_CASE("a joint violated at the start is refused by name") {
  Model apart = sled();
  apart.bodies[2].initial_pose.position_m.x() += 1e-3;
  CHECK_THROWS_AS(simulate(apart, {}, kShort), InputError);
  CHECK_THROWS_WITH(simulate(apart, {}, kShort), Contains("'top'") && Contains("0.001 m"));

  Model turned = sled();
  turned.bodies[1].initial_pose.rotation = Eigen::AngleAxisd(0.01, Vector3d::UnitX());
  CHECK_THROWS_WITH(simulate(turned, {}, kShort), Contains("'base'") && Contains("0.01 rad"));

  Model parting = sled();
  parting.bodies[2].initial_velocity_m_s.setZero();
  CHECK_THROWS_WITH(simulate(parting, {}, kShort), Contains("'top'") && Contains("4 m/s"));
}

TEST_CASE("poses that fit a joint but for rounded digits are brought onto it") {
  Model rounded = sled();
  rounded.bodies[2].initial_pose.position_m.x() += 5e-8;
  const History history = simulate(rounded, {}, kShort);
  const Vector3d gap =
      history.marker("tip").position_m.col(0) - history.marker("head").position_m.col(0);
  CHECK(gap.norm() < 1e-14);
}

TEST_CASE("outputs that are handed on in blocks are those of a whole run") {
  const Model model = sled();
  const bool moves = GENERATE(true, false);
  const auto run = [&](const OutputOptions& output) {
    return moves ? simulate(model, {}, output) : settle(model, {}, output);
  };
  const History whole = run(kShort);
  std::vector<History> blocks;
  OutputOptions in_blocks = kShort;
  in_blocks.block = 7;
  in_blocks.sink = [&](const History& outputs) { blocks.push_back(outputs); };
  blocks.push_back(run(in_blocks));
  REQUIRE(blocks.size() == 8);
  REQUIRE(whole.time_s.size() == 51);
  Eigen::Index first = 0;
  for (const History& block : blocks) {
    const Eigen::Index n = block.time_s.size();
    REQUIRE(block.handed_on == first);
    CHECK(n == (first == 49 ? 2 : 7));
    CHECK(block.time_s == whole.time_s.segment(first, n));
    CHECK(block.marker("tip").rotation == whole.marker("tip").rotation.middleCols(first, n));
    CHECK(block.joint("top").force_N == whole.joint("top").force_N.middleCols(first, n));
    CHECK(block.modal[0].coordinates == whole.modal[0].coordinates.middleCols(first, n));
    CHECK(block.energy.work_J == whole.energy.work_J.segment(first, n));
    CHECK(block.constraints.position_m == whole.constraints.position_m.segment(first, n));
    first += n;
  }
  CHECK(blocks.back().statistics.evaluations == whole.statistics.evaluations);
}

TEST_CASE("an output of a history has 19 numbers a marker, 6 a joint, one a mode and ten more") {
  // Per marker: position, velocity, acceleration, angular velocity and acceleration, a quaternion;
  // per joint: force and moment; then time, five energies and four residuals.
  const Model model = sled();
  CHECK(numbers_per_output(model) == 19 * 5 + 6 * 2 + 4 + 10);
}

TEST_CASE("joints that repeat each other are named and move nothing") {
  Model twice = sled();
  twice.joints.push_back({"again", &kSphericalJoint, 2, 3});
  const History history = simulate(twice, tolerance(1e-9), kShort);
  const History once = simulate(sled(), tolerance(1e-9), kShort);
  REQUIRE(history.redundant_constraints.size() == 3);
  CHECK(history.redundant_constraints[0] == "joint 'again', position row 1");
  CHECK((history.marker("head").position_m - once.marker("head").position_m).cwiseAbs().maxCoeff() <
        1e-8);
  // Either joint may carry the force; the moment and the loads below are determined.
  CHECK(history.joint("again").undetermined == "force x, force y, force z");
  CHECK(history.joint("top").undetermined == "force x, force y, force z");
  CHECK(history.joint("base").undetermined.empty());
  CHECK(once.redundant_constraints.empty());
}

/// A model with an unbounded force from 5 ms on.
Model wild_sled() {
  Model wild = sled();
  wild.forces.add(
      PointForce{"huge", 3, Vector3d::UnitX(),
                 TimeTable({0, 0.005, 0.05}, {0, 0, 1e300}, TimeTable::Outside::constant)});
  return wild;
}

TEST_CASE("a run that cannot go on says when and why and keeps what it has") {
  const Formulation formulation = GENERATE(Formulation::descriptor, Formulation::recursive);
  SolverOptions solver = tolerance(1e-6);
  solver.formulation = formulation;
  const OutputOptions fine{.end_time_s = 0.05, .interval_s = 1e-3};
  try {
    simulate(wild_sled(), solver, fine);
    FAIL("a force without bound was integrated");
  } catch (const IncompleteRun& run) {
    CHECK_THAT(run.what(), Contains(" s;") && Contains("it is limited by the ") &&
                               (Contains("body '") || Contains("joint '")));
    CHECK(run.history.incomplete == run.what());
    REQUIRE(run.history.time_s.size() == 6);
    CHECK(run.history.time_s[5] == Approx(0.005));
    CHECK(run.history.marker("head").position_m.cols() == 6);
    const History calm = simulate(sled(), solver, fine);
    CHECK((run.history.marker("head").position_m - calm.marker("head").position_m.leftCols<6>())
              .cwiseAbs()
              .maxCoeff() < 1e-9);
  }
}

TEST_CASE("a run that needs more steps than allowed is given up") {
  SolverOptions solver = tolerance(1e-9);
  solver.max_steps = 5;
  CHECK_THROWS_WITH(simulate(sled(), solver, kShort),
                    Contains("after 5 steps") && Contains("the step size is limited"));
}

TEST_CASE("options that make no sense are refused") {
  SolverOptions negative;
  negative.relative_tolerance = -1;
  CHECK_THROWS_AS(simulate(sled(), negative, kShort), InputError);
  CHECK_THROWS_AS(simulate(sled(), {}, {0, 1e-3}), InputError);
  CHECK_THROWS_AS(simulate(sled(), {}, {1, std::numeric_limits<double>::quiet_NaN()}), InputError);
}
