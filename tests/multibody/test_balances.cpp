// SPDX-License-Identifier: GPL-3.0-or-later
// A chain with every kind of joint and a deformable body flies freely: whatever internal forces
// act, its momenta are constant, and its energy changes only as recorded.
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "multibody/descriptor/system.h"
#include "multibody/equations/equations.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/time/dormand_prince.h"
#include "multibody/time/motion.h"
#include "multibody/tree/tree_dynamics.h"
#include "tests/support/formulations.h"
#include "tests/support/tree_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kEnd_s = 0.3;

/// The chain rotates as one body about the origin, which every joint permits.
ModelBuilder flying_chain(bool stiffens) {
  RandomNumbers random(83);
  ModelBuilder build;
  const Vector3d spin(2, -1, 3);
  const Vector3d axis(0, 0.6, 0.8);
  Vector3d place(0.1, 0.2, 0.3);
  const auto first =
      build.body("root", random_rigid_body(random), {place}, spin.cross(place), spin);
  std::size_t inner = build.marker("root end", first, {0.2, 0, 0.1});
  place += Vector3d(0.2, 0, 0.1);
  const auto join = [&](const JointKind* kind, std::size_t outer) {
    build.joint("joint " + std::to_string(build.model.joints.size()), kind, inner, outer, axis);
    build.model.joints.back().lead_m = 0.2;
  };
  const auto lump = make_point_mass_body(61, 3).body;
  const Vector3d side = lump.interface("side").position_m;
  const Vector3d origin = place - side;
  DeformableBody elastic = deformable(lump, 0.1);
  elastic.stress_stiffening = stiffens;
  const auto soft = build.body("soft", elastic, {origin}, spin.cross(origin), spin);
  join(&kSphericalJoint, build.interface_marker("soft side", soft, "side"));
  inner = build.interface_marker("soft tip", soft, "tip");
  place = origin + lump.interface("tip").position_m;
  for (const JointKind* const kind : {&kUniversalJoint, &kCylindricalJoint, &kPrismaticJoint,
                                      &kRevoluteJoint, &kFixedJoint, &kPlanarJoint, &kScrewJoint}) {
    const std::string name = std::to_string(build.model.bodies.size());
    const auto body =
        build.body("body " + name, random_rigid_body(random), {place}, spin.cross(place), spin);
    join(kind, build.marker("outer " + name, body));
    const Vector3d next = 0.3 * random.vector();
    inner = build.marker("inner " + name, body, next);
    place += next;
  }
  return build;
}

Resistance make_resistance() {
  Resistance resistance;
  resistance.positive.curve = LoadCurve::cubic(30, 5, 60);
  resistance.positive.stop = 0.05;
  resistance.positive.beyond_stop = LoadCurve::cubic(0, 400, 50);
  resistance.positive.unloading_ratio = 0.4;
  resistance.negative.curve = LoadCurve::table({0, 0.1, 0.5}, {0, 5, 12});
  resistance.damping = 0.4;
  resistance.friction = 0.8;
  resistance.full_rate = 2;
  return resistance;
}

/// Adds one kind of force between bodies.
void add_force(Model& model, int kind) {
  const auto marker = [&](const char* name) { return model.marker_index(name); };
  const auto resist = [&](const JointKind* of, JointCoordinate coordinate) {
    for (std::size_t k = 0; k < model.joints.size(); ++k)
      if (model.joints[k].kind == of)
        model.forces.add(
            JointResistance{"resistance " + std::to_string(k), k, coordinate, make_resistance()});
  };
  switch (kind) {
    case 0:
      model.forces.add(
          MarkerSpring{"spring", marker("root end"), marker("inner 5"), 0.1, make_resistance()});
      return;
    case 1: {
      Resistance rope;
      rope.positive.curve = LoadCurve::cubic(80);
      rope.damping = 2;
      rope.tension_only = true;
      model.forces.add(MarkerSpring{"rope", marker("soft tip"), marker("inner 6"), 0.1, rope});
      return;
    }
    case 2: {
      RandomNumbers random(91);
      Eigen::Matrix<double, 6, 6> root;
      random.fill(root);
      model.forces.add(Bushing{"bushing", marker("soft tip"), marker("inner 4"),
                               20 * root * root.transpose(), 0.2 * root.transpose() * root});
      return;
    }
    case 3:
      resist(&kCylindricalJoint, JointCoordinate::distance);
      resist(&kPrismaticJoint, JointCoordinate::distance);
      return;
    case 4:
      resist(&kRevoluteJoint, JointCoordinate::angle);
      return;
    default:
      resist(&kSphericalJoint, JointCoordinate::flexion);
      resist(&kUniversalJoint, JointCoordinate::flexion);
  }
}
constexpr int kForceKinds = 6;

struct Momentum {
  Vector3d linear = Vector3d::Zero();
  Vector3d angular = Vector3d::Zero();  ///< about the world's origin
};

void add(const FreeBody& body, const BodyState& state, Momentum& sum) {
  BodyTerms terms(body.constants);
  terms.A = state.rotation;
  terms.a = state.modal;
  update_configuration(body.constants, terms);
  const VectorXd momenta = terms.mass * state.velocities;
  sum.linear += momenta.head<3>();
  sum.angular += state.position_m.cross(momenta.head<3>()) + terms.A * momenta.segment<3>(3);
}

Momentum momentum_of(const Model& model, Formulation formulation, const VectorXd& state) {
  const System system(model);
  Momentum sum;
  if (formulation == Formulation::recursive) {
    const tree::Tree tree(model);
    tree::TreeDynamics dynamics(tree);
    dynamics.update(0, state);
    dynamics.solve();
    for (std::size_t b = 0; b < tree.bodies.size(); ++b)
      for (const FreeBody& body : system.bodies)
        if (body.index == tree.bodies[b].index) add(body, dynamics.body_state(b), sum);
    return sum;
  }
  for (const FreeBody& body : system.bodies) {
    const auto q = state.segment<4>(body.position + 3);
    add(body,
        {state.segment<3>(body.position),
         Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix(),
         state.segment(body.position + 7, body.constants.mode_count()),
         state.segment(system.position_count + body.velocity, body.constants.velocity_count()),
         {}},
        sum);
  }
  return sum;
}

VectorXd state_at_end(Equations& equations, const VectorXd& start, const SolverOptions& solver) {
  const auto integrator = time_integrator(equations, 0, start, solver);
  while (integrator->time_s() < kEnd_s) integrator->step(kEnd_s);
  return integrator->state();
}

}  // namespace

TEST_CASE("No joint and no force between bodies changes the momenta of a free chain") {
  ModelBuilder build = flying_chain(GENERATE(false, true));
  for (int kind = 0; kind < kForceKinds; ++kind) add_force(build.model, kind);
  const SolverOptions solver = solver_of(1e-10, 1e-13);
  const auto equations = solver.formulation == Formulation::recursive
                             ? recursive_equations(build.model, solver)
                             : descriptor_equations(build.model, solver);
  const VectorXd start = equations->given_state();
  const VectorXd end = state_at_end(*equations, start, solver);
  REQUIRE((end - start).norm() > 1);
  const Momentum before = momentum_of(build.model, solver.formulation, start);
  const Momentum after = momentum_of(build.model, solver.formulation, end);
  // Some hundred steps have errors of 1e-10 each.
  CHECK((after.linear - before.linear).norm() < 1e-8 * before.linear.norm());
  CHECK((after.angular - before.angular).norm() < 1e-8 * before.angular.norm());
}

TEST_CASE("Every force closes the balance of energy across every kind of joint") {
  const int kind = GENERATE(range(0, kForceKinds));
  CAPTURE(kind);
  ModelBuilder build = flying_chain(GENERATE(false, true));
  build.model.gravity_m_s2 = {1, 2, -kGravity};
  add_force(build.model, kind);
  const SolverOptions solver = solver_of(1e-10, 1e-13);
  const History history =
      simulate(build.model, solver, {.end_time_s = kEnd_s, .interval_s = kEnd_s / 10});
  const EnergyHistory& energy = history.energy;
  const VectorXd sum =
      energy.kinetic_J + energy.gravitational_J + energy.strain_J + energy.dissipated_J;
  const double exchanged = energy.kinetic_J.maxCoeff() - energy.kinetic_J.minCoeff();
  CHECK(exchanged > 1);
  CHECK(energy.strain_J.maxCoeff() > 1e-3);
  CHECK(energy.dissipated_J[10] > 1e-3);
  CHECK(energy.work_J.isZero(0));
  CHECK((sum.array() - sum[0]).abs().maxCoeff() < 1e-8 * exchanged);
}
