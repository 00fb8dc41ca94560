// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <cstdlib>

#include <catch2/catch.hpp>

#include "multibody/dormand_prince.h"
#include "multibody/equations_of_motion.h"
#include "multibody/initial_state.h"
#include "multibody/projection.h"
#include "multibody/state_error.h"
#include "tests/support/point_mass_body.h"

// The linker sends every call of malloc in our objects, Eigen's included, through here
// (tests/multibody/CMakeLists.txt).
namespace {
std::atomic<long> allocations{0};
}

extern "C" {
void* __real_malloc(std::size_t size);  // NOLINT: the linker's name
void* __wrap_malloc(std::size_t size);  // NOLINT
void* __wrap_malloc(std::size_t size) {
  ++allocations;
  return __real_malloc(size);
}
}

using Eigen::Vector3d;
using Eigen::VectorXd;
using namespace flexneck::multibody;

TEST_CASE("a step allocates nothing") {
  const auto body = flexneck::testing::make_point_mass_body(71, 4).body;
  Model model;
  model.gravity_m_s2 = {0, 0, -9.81};
  model.bodies.push_back({"ground", DrivenBody{}, {}});
  model.bodies.push_back({"neck", DeformableBody{body, VectorXd::Constant(4, 0.5)}, {}});
  RigidBody head;
  head.mass_kg = 3;
  head.center_m = {0.02, 0.01, 0.05};
  head.inertia_kg_m2 = Vector3d(0.016, 0.024, 0.022).asDiagonal();
  model.bodies.push_back({"head", head, {body.interface("tip").position_m}});
  model.markers = {{"wall", 0, ""}, {"root", 1, "root"}, {"tip", 1, "tip"}, {"head", 2, ""}};
  model.joints = {{"base", JointKind::fixed, 0, 1}, {"top", JointKind::pin, 2, 3}};
  model.forces.push_back(
      {"push", 3, Vector3d::UnitX(), TimeTable({0, 1}, {0, 9}, TimeTable::Outside::constant)});

  const System system(model);
  EquationsOfMotion equations(system);
  Projection projection(equations);
  const StateError error(system, 1e-6, 1e-9);
  VectorXd state = given_state(model, system);
  join(model, equations, state, Check::positions_and_velocities);
  InitialValueProblem problem;
  problem.derivative = [&](double t, const VectorXd& y, VectorXd& rate) {
    equations.evaluate(t, y, rate);
  };
  problem.finish_step = [&](double t, VectorXd& y, VectorXd& rate) {
    projection.apply(t, y);
    equations.evaluate_updated(y, rate);
  };
  problem.measure = [&](const VectorXd& begin, const VectorXd& end, const VectorXd& difference) {
    return error(begin, end, difference);
  };
  DormandPrince integrator(problem, {0.05, 1e-10}, 0, state);

  // That the count works at all: a copy that the compiler cannot do away with.
  const long before_control = allocations;
  const VectorXd control = state;
  const long control_count = allocations - before_control;
  const long before = allocations;
  for (int k = 0; k < 20; ++k) {
    integrator.step(1.0);
    integrator.interpolate(integrator.time_s() - 1e-6, state);
    projection.apply(integrator.time_s() - 1e-6, state);
    equations.solve();
  }
  const long during_steps = allocations - before;
  REQUIRE(control_count == 1);
  REQUIRE(control.size() == state.size());
  CHECK(during_steps == 0);
}
