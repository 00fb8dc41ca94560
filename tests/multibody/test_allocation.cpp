// SPDX-License-Identifier: GPL-3.0-or-later
#include <atomic>
#include <cstdlib>
#include <functional>
#include <vector>

#include <catch2/catch.hpp>

#include "multibody/descriptor/equations_of_motion.h"
#include "multibody/descriptor/initial_state.h"
#include "multibody/descriptor/projection.h"
#include "multibody/descriptor/state_error.h"
#include "multibody/equations/equations.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/time/dormand_prince.h"
#include "multibody/time/generalised_alpha.h"
#include "multibody/time/motion.h"
#include "multibody/tree/tree_dynamics.h"
#include "multibody/tree/tree_error.h"
#include "multibody/tree/tree_start.h"
#include "tests/support/point_mass_body.h"

// The linker redirects every call of malloc, calloc (to which the compiler converts malloc and
// zeros) and operator new in the program's objects, those of Eigen and of containers included, to
// these functions (tests/multibody/CMakeLists.txt).
namespace {
std::atomic<long> allocations{0};
}

extern "C" {
void* real_malloc(std::size_t size) __asm__("__real_malloc");
void* counting_malloc(std::size_t size) __asm__("__wrap_malloc");
void* counting_malloc(std::size_t size) {
  ++allocations;
  return real_malloc(size);
}
void* real_calloc(std::size_t count, std::size_t size) __asm__("__real_calloc");
void* counting_calloc(std::size_t count, std::size_t size) __asm__("__wrap_calloc");
void* counting_calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return real_calloc(count, size);
}
void* real_new(std::size_t size) __asm__("__real__Znwm");
void* counting_new(std::size_t size) __asm__("__wrap__Znwm");
void* counting_new(std::size_t size) {
  ++allocations;
  return real_new(size);
}
}

using Eigen::Vector3d;
using Eigen::VectorXd;
using namespace flexneck::multibody;

namespace {

constexpr StepLimits kLimits{0.05, 1e-10};

/// Adds springs with every law between two bodies.
void add_springs(Model& model) {
  Resistance law;
  law.positive.curve = LoadCurve::table({0, 0.1, 0.3}, {0, 5, 6});
  law.positive.stop = 0.02;
  law.positive.beyond_stop = LoadCurve::cubic(50);
  law.positive.unloading_ratio = 0.5;
  law.negative = law.positive;
  law.friction = 0.1;
  law.full_rate = 0.01;
  model.forces.add(MarkerSpring{"spring", 0, 3, 0.1, law});
  model.forces.add(Bushing{"bushing", 0, 3, {}, {}});
  model.forces.of<Bushing>()[0].stiffness.setIdentity();
  model.forces.of<Bushing>()[0].damping.setIdentity();
  model.forces.add(JointResistance{"turning", 1, JointCoordinate::angle, law});
  model.forces.add(JointResistance{"bending", 1, JointCoordinate::flexion, law});
}

Model neck_and_head(bool stiffens) {
  const auto body = flexneck::testing::make_point_mass_body(71, 4).body;
  Model model;
  model.gravity_m_s2 = {0, 0, -9.81};
  model.bodies.push_back({"ground", PrescribedBody{}, {}});
  model.bodies.push_back(
      {"neck", DeformableBody{body, VectorXd::Constant(4, 0.5), {}, stiffens}, {}});
  RigidBody head;
  head.mass_kg = 3;
  head.center_m = {0.02, 0.01, 0.05};
  head.inertia_kg_m2 = Vector3d(0.016, 0.024, 0.022).asDiagonal();
  model.bodies.push_back({"head", head, {body.interface("tip").position_m}});
  model.markers = {{"wall", 0, ""}, {"root", 1, "root"}, {"tip", 1, "tip"}, {"head", 2, ""}};
  model.joints = {{"base", &kFixedJoint, 0, 1}, {"top", &kRevoluteJoint, 2, 3}};
  model.forces.add(PointForce{"push", 3, Vector3d::UnitX(),
                              TimeTable({0, 1}, {0, 9}, TimeTable::Outside::constant)});
  add_springs(model);
  return model;
}

/// Checks steps and outputs of a run with given equations.
void check_no_allocation(TimeIntegrator& integrator,
                         const std::function<void(double, VectorXd&)>& output) {
  VectorXd state = integrator.state();
  // Control that the count works: copies that the compiler cannot remove.
  const long before_control = allocations;
  const VectorXd control = state;
  const std::vector<double> other(static_cast<std::size_t>(state.size()));
  const long control_count = allocations - before_control;
  const long before = allocations;
  for (int k = 0; k < 20; ++k) {
    integrator.step(1.0);
    integrator.interpolate(integrator.time_s() - 1e-6, state);
    output(integrator.time_s() - 1e-6, state);
  }
  const long during_steps = allocations - before;
  REQUIRE(control_count == 2);
  REQUIRE(static_cast<std::size_t>(control.size()) == other.size());
  CHECK(during_steps == 0);
}

}  // namespace

TEST_CASE("a step of the descriptor form allocates nothing") {
  const Model model = neck_and_head(GENERATE(false, true));
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
  DormandPrince integrator(problem, kLimits, 0, state);
  check_no_allocation(integrator, [&](double t, VectorXd& y) {
    projection.apply(t, y, false);
    equations.solve();
  });
}

TEST_CASE("a step of the recursive form allocates nothing") {
  const Model model = neck_and_head(GENERATE(false, true));
  const tree::Tree tree(model);
  tree::TreeDynamics dynamics(tree);
  const tree::TreeError error(tree, 1e-6, 1e-9);
  InitialValueProblem problem;
  problem.derivative = [&](double t, const VectorXd& y, VectorXd& rate) {
    dynamics.evaluate(t, y, rate);
  };
  problem.finish_step = [&](double t, VectorXd& y, VectorXd& rate) {
    dynamics.evaluate(t, y, rate);
  };
  problem.measure = [&](const VectorXd& begin, const VectorXd& end, const VectorXd& difference) {
    return error(begin, end, difference);
  };
  DormandPrince integrator(problem, kLimits, 0, tree::given_state(tree));
  check_no_allocation(integrator, [&](double t, VectorXd& y) {
    dynamics.update(t, y);
    dynamics.solve();
    MarkerState motion;
    for (std::size_t k = 0; k < model.markers.size(); ++k) dynamics.marker_state(k, motion);
    dynamics.energies();
  });
}

TEST_CASE("steps that end at events allocate nothing in either form") {
  const Model model = neck_and_head(false);
  const SolverOptions solver{.relative_tolerance = 1e-6, .absolute_tolerance = 1e-9};
  for (const bool recursive : {true, false}) {
    CAPTURE(recursive);
    const auto equations =
        recursive ? recursive_equations(model, solver) : descriptor_equations(model, solver);
    const auto integrator = time_integrator(*equations, 0, equations->given_state(), solver);
    int events = 0;
    check_no_allocation(*integrator, [&](double, VectorXd&) {
      if (integrator->reason() == StepReason::event) ++events;
    });
    CHECK(events > 0);
  }
}

TEST_CASE("a step of the generalised-alpha method allocates nothing in either form") {
  const Model model = neck_and_head(GENERATE(false, true));
  const SolverOptions solver{.relative_tolerance = 1e-4, .absolute_tolerance = 1e-7};
  for (const bool recursive : {true, false}) {
    CAPTURE(recursive);
    const auto equations =
        recursive ? recursive_equations(model, solver) : descriptor_equations(model, solver);
    const VectorXd start = equations->given_state();
    GeneralisedAlpha integrator(*equations, 0.8, kLimits, 0, start);
    check_no_allocation(integrator, [](double, VectorXd&) {});
    // Linearisations were among the steps.
    CHECK(integrator.linearisations() > 0);
  }
}
