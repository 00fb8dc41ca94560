// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies whose masses differ by many orders, and bodies without inertia about an axis.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/equations/equations.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using Catch::Matchers::Contains;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using flexneck::ComputationError;
using flexneck::InputError;
using flexneck::testing::either_formulation;
using flexneck::testing::kGravity;
using flexneck::testing::ModelBuilder;
using flexneck::testing::solver_of;
using namespace flexneck::multibody;

namespace {

/// Gravity with a component out of the plane of a revolute joint.
const Vector3d kOblique(0, 2, -kGravity);

/// A rotation in the plane of x and z.
Eigen::Quaterniond turned(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
}

/// A body with the given moment of inertia about every axis through its centre.
RigidBody body_of(double mass_kg, double moment, const Vector3d& center_m = Vector3d::Zero()) {
  return {mass_kg, center_m, moment * Matrix3d::Identity()};
}

/// Adds two cranks of one metre that hang from the ground, two metres apart, at an angle, and carry
/// a bar. The names of its joints have the prefix.
void add_parallelogram(ModelBuilder& build, std::size_t ground, const std::string& prefix,
                       const Vector3d& place, double angle, double mass_kg, double moment) {
  const Eigen::Quaterniond R = turned(angle);
  const Vector3d down = R * Vector3d(0, 0, -1);
  const RigidBody crank = body_of(mass_kg, moment, {0, 0, -0.5});
  const auto bar = build.body(prefix + "bar", body_of(mass_kg, moment, {1, 0, 0}), {place + down});
  for (const double x : {0.0, 2.0}) {
    const std::string name = prefix + (x == 0 ? "left" : "right");
    const Vector3d at(x, 0, 0);
    const auto body = build.body(name, crank, {place + at, R});
    build.joint(name + " top", &kRevoluteJoint, build.marker(name + " ground", ground, place + at),
                build.marker(name + " top", body));
    build.joint(name + " foot", &kRevoluteJoint, build.marker(name + " foot", body, {0, 0, -1}),
                build.marker(name + " end", bar, at));
  }
  build.marker(prefix + "tip", bar);
}

/// Adds a link of two metres between a heavy body that hangs from the ground and one that hangs
/// from the link.
void add_chain(ModelBuilder& build, std::size_t ground) {
  const RigidBody heavy = body_of(1000, 5000, {0, 0, -0.5});
  const Eigen::Quaterniond R = turned(0.7);
  const auto along = [&](double length) -> Vector3d { return R * Vector3d(0, 0, -length); };
  const auto upper = build.body("upper", heavy, {Vector3d::Zero(), R});
  const auto link = build.body("link", body_of(1e-3, 1e-8), {along(2), R});
  const auto lower = build.body("lower", heavy, {along(3), R});
  build.joint("top", &kRevoluteJoint, build.marker("ground", ground), build.marker("top", upper));
  build.joint("first", &kRevoluteJoint, build.marker("foot", upper, {0, 0, -1}),
              build.marker("link top", link, {0, 0, 1}), Vector3d::UnitX());
  build.joint("second", &kRevoluteJoint, build.marker("link foot", link, {0, 0, -1}),
              build.marker("lower top", lower));
  build.marker("end", lower, {0, 0, -1});
}

SolverOptions tight(Formulation formulation) {
  return {.relative_tolerance = 1e-9, .absolute_tolerance = 1e-12, .formulation = formulation};
}

double largest_difference(const History& a, const History& b, const std::string& marker) {
  return (a.marker(marker).position_m - b.marker(marker).position_m).cwiseAbs().maxCoeff();
}

/// A point mass of 2 kg, 0.8 m from a joint at the ground, at an angle.
Model point_pendulum(const JointKind* kind, double angle) {
  ModelBuilder build;
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  const auto ground = build.ground();
  const auto bob =
      build.body("bob", body_of(2, 0, {0, 0, -0.8}), {Vector3d::Zero(), turned(angle)});
  build.joint("pivot", kind, build.marker("ground", ground), build.marker("pivot", bob));
  build.marker("point", bob, {0, 0, -0.8});
  return build.model;
}

}  // namespace

TEST_CASE(
    "a parallelogram of heavy bars without rotary inertia swings as the pendulum that it is") {
  ModelBuilder build;
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  add_parallelogram(build, build.ground(), "", Vector3d::Zero(), 1.0, 100, 1e-10);
  const OutputOptions output{3, 0.1};
  const History found = simulate(build.model, tight(Formulation::descriptor), output);
  CHECK(found.redundant_constraints.size() == 3);
  CHECK(found.statistics.max_position_residual < 1e-9);

  // The bar only translates: a moment of 200 kg m, an inertia of 150 kg m^2 about the pivot.
  ModelBuilder single;
  single.model.gravity_m_s2 = {0, 0, -kGravity};
  const auto ground = single.ground();
  const auto body =
      single.body("body", body_of(400, 50, {0, 0, -0.5}), {Vector3d::Zero(), turned(1.0)});
  single.joint("top", &kRevoluteJoint, single.marker("ground", ground), single.marker("top", body));
  single.marker("tip", body, {0, 0, -1});
  const History expected = simulate(single.model, tight(Formulation::recursive), output);
  CHECK(largest_difference(found, expected, "tip") < 1e-7);
}

TEST_CASE("a light link between heavy bodies moves as in joint coordinates, beside a loop too") {
  ModelBuilder chain;
  chain.model.gravity_m_s2 = kOblique;
  add_chain(chain, chain.ground());
  const OutputOptions output{1.5, 0.05};
  const History expected = simulate(chain.model, tight(Formulation::recursive), output);
  const History found = simulate(chain.model, tight(Formulation::descriptor), output);
  CHECK(found.redundant_constraints.empty());
  CHECK(largest_difference(found, expected, "end") < 1e-6);

  ModelBuilder both;
  both.model.gravity_m_s2 = kOblique;
  const auto ground = both.ground();
  add_chain(both, ground);
  add_parallelogram(both, ground, "loop ", {10, 0, 0}, 0.5, 2, 0.2);
  const History beside = simulate(both.model, tight(Formulation::automatic), output);
  CHECK(largest_difference(beside, expected, "end") < 1e-6);
}

TEST_CASE("a point mass on a pin swings with the period of the elliptic integral") {
  constexpr double kAngle = 2.0;
  // Period by the arithmetic-geometric mean: T = 2 pi sqrt(l / g) / agm(1, cos(angle / 2)).
  double a = 1;
  double b = std::cos(kAngle / 2);
  for (int k = 0; k < 6; ++k) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b);
    a = mean;
  }
  const double period = 2 * std::numbers::pi * std::sqrt(0.8 / kGravity) / a;
  const History history = simulate(point_pendulum(&kRevoluteJoint, kAngle), solver_of(1e-10, 1e-13),
                                   {period, period / 4});
  const auto& places = history.marker("point").position_m;
  CHECK((places.col(4) - places.col(0)).norm() < 1e-8);
  CHECK((places.col(1) - Vector3d(0, 0, -0.8)).norm() < 1e-8);
}

TEST_CASE("a rotation that moves no mass and that no joint holds is refused by body and axis") {
  SolverOptions solver;
  solver.formulation = either_formulation();
  const Model model = point_pendulum(&kSphericalJoint, 0.3);
  CHECK_THROWS_AS(simulate(model, solver, {}), InputError);
  CHECK_THROWS_WITH(simulate(model, solver, {}), Contains("'bob'") && Contains("(0, 0, 1)"));
  CHECK_THROWS_WITH(simulate_from_equilibrium(model, solver, {}), Contains("'bob'"));
}

TEST_CASE("an output that misses a joint ends a run, with the joint's name") {
  const Model model = point_pendulum(&kRevoluteJoint, 0.3);
  const auto equations = descriptor_equations(model, {});
  Eigen::VectorXd state = equations->given_state();
  Eigen::VectorXd rate(state.size());
  equations->derivative(0, state, rate);
  Recorder recorder(model, OutputOptions{1, 0.5});
  CHECK_NOTHROW(equations->record(0, state, recorder, 0));
  // A quarter of a turn away from the joint's axis one step of Newton's method is far off.
  state.segment<4>(3) << std::cos(0.75), std::sin(0.75), 0, 0;
  CHECK_THROWS_AS(equations->record(0.5, state, recorder, 1), ComputationError);
  CHECK_THROWS_WITH(equations->record(0.5, state, recorder, 1),
                    Contains("'pivot'") && Contains("0.5 s"));
}
