// SPDX-License-Identifier: GPL-3.0-or-later
// The recursive formulation, compared with the descriptor form, which shares with it the model, the
// invariants and the coefficients of a rotation vector's series.
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/descriptor/equations_of_motion.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/tree/tree_dynamics.h"
#include "multibody/tree/tree_error.h"
#include "multibody/tree/tree_start.h"
#include "tests/support/test_models.h"
#include "tests/support/tree_models.h"

using Eigen::Index;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;
using namespace flexneck::multibody;
using namespace flexneck::testing;

namespace {

constexpr double kAgreement = 1e-12;

VectorXd random_state(const tree::Tree& tree) {
  RandomNumbers random(52);
  VectorXd state = VectorXd::Zero(tree.state_count());
  for (const tree::TreeBody& body : tree.bodies) {
    const Index nq = body.joint.position_count();
    const Index m = body.inertia.mode_count();
    state.segment(body.position, nq) = random.vector(nq);
    if (nq > body.joint.velocity_count()) state.segment<4>(body.position + nq - 4).normalize();
    state.segment(body.position + nq, m) = 0.05 * random.vector(m);
  }
  state.segment(tree.position_count, tree.velocity_count) =
      1.5 * random.vector(tree.velocity_count);
  return state;
}

/// The descriptor form's state of the same motion.
VectorXd descriptor_state(const System& system, const tree::TreeDynamics& dynamics) {
  VectorXd state = VectorXd::Zero(system.state_count());
  for (std::size_t b = 0; b < dynamics.tree().bodies.size(); ++b) {
    const BodyState body = dynamics.body_state(b);
    for (const FreeBody& free : system.bodies) {
      if (free.index != dynamics.tree().bodies[b].index) continue;
      const Quaterniond q(body.rotation);
      state.segment<3>(free.position) = body.position_m;
      state.segment<4>(free.position + 3) << q.w(), q.x(), q.y(), q.z();
      state.segment(free.position + 7, body.modal.size()) = body.modal;
      state.segment(system.position_count + free.velocity, body.velocities.size()) =
          body.velocities;
    }
  }
  return state;
}

Model any_model() {
  const int number = GENERATE(0, 1, 2);
  if (number == 2) return chain_of_all_joints();
  Model model = forest(number == 1);
  if (number == 1)
    model.forces.add(Cable{"cable", model.marker_index("d end"), model.marker_index("k g"),
                           Vector3d::UnitX(), 0.1, 5, 40, 0.01});
  return model;
}

}  // namespace

TEST_CASE("both formulations give the same accelerations, reactions and powers at equal state") {
  const Model model = any_model();
  const tree::Tree tree(model);
  tree::TreeDynamics dynamics(tree);
  const VectorXd state = random_state(tree);
  VectorXd rate = VectorXd::Zero(state.size());
  constexpr double kTime_s = 0.4;
  dynamics.evaluate(kTime_s, state, rate);

  const System system(model);
  EquationsOfMotion equations(system);
  const VectorXd absolute = descriptor_state(system, dynamics);
  VectorXd absolute_rate = VectorXd::Zero(absolute.size());
  equations.evaluate(kTime_s, absolute, absolute_rate);
  // The tree satisfies the joints, in velocity too.
  REQUIRE(equations.position_residual().lpNorm<Eigen::Infinity>() < 1e-14);
  REQUIRE(equations.velocity_residual().lpNorm<Eigen::Infinity>() < 1e-13);

  const double size = equations.accelerations().lpNorm<Eigen::Infinity>();
  REQUIRE(size > 10);
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) {
    const BodyState body = dynamics.body_state(b);
    for (const FreeBody& free : system.bodies) {
      if (free.index != tree.bodies[b].index) continue;
      CAPTURE(free.name);
      const VectorXd expected =
          equations.accelerations().segment(free.velocity, body.accelerations.size());
      CHECK((body.accelerations - expected).norm() < kAgreement * size);
    }
  }
  for (std::size_t k = 0; k < model.joints.size(); ++k) {
    CAPTURE(k);
    const Reaction found = dynamics.joint_reaction(k);
    const Reaction expected = equations.joint_reaction(k);
    const double load = expected.force_N.norm() + expected.moment_Nm.norm();
    CHECK((found.force_N - expected.force_N).norm() <= 10 * kAgreement * load);
    CHECK((found.moment_Nm - expected.moment_Nm).norm() <= 10 * kAgreement * load);
  }
  const Index nv = tree.position_count + tree.velocity_count;
  CHECK(rate[nv] ==
        Approx(absolute_rate[system.position_count + system.velocity_count]).epsilon(kAgreement));
  CHECK(rate[nv + 1] == Approx(absolute_rate[system.position_count + system.velocity_count + 1])
                            .epsilon(10 * kAgreement));
}

TEST_CASE(
    "what rides on a base that does not turn moves the same without its inertia, bit by bit") {
  const TimeTable brake({0, 1}, {-100, -220}, TimeTable::Outside::constant);
  const bool turns = GENERATE(false, true);
  PrescribedBody base{Vector3d(2, 1, 0).normalized(), 4, brake};
  if (turns) base.turn.initial_rate_rad_s = 2;
  ModelBuilder build = head_on_neck(base, hanging_pose(), Beam{}, 0.3, make_head());
  build.model.gravity_m_s2 = {1, 2, -kGravity};
  const tree::Tree tree(build.model);
  REQUIRE(tree.bodies[0].rides == !turns);
  tree::TreeDynamics motion(tree);
  tree::TreeDynamics reactions(tree);
  const VectorXd state = random_state(tree);
  VectorXd rate(state.size());
  motion.evaluate(0.4, state, rate);
  reactions.update(0.4, state);
  reactions.solve();
  VectorXd same(state.size());
  reactions.fill_rate(state, reactions.accelerations(), same);
  CHECK(rate == same);
  // Forces are equal too; only the moment was left out.
  CHECK(motion.joint_reaction(0).force_N == reactions.joint_reaction(0).force_N);
  CHECK((motion.joint_reaction(0).moment_Nm == reactions.joint_reaction(0).moment_Nm) == turns);
}

TEST_CASE("a tree's markers and energies are those of the descriptor form") {
  const Model model = any_model();
  const tree::Tree tree(model);
  tree::TreeDynamics dynamics(tree);
  const VectorXd state = random_state(tree);
  dynamics.update(0, state);
  dynamics.solve();
  const System system(model);
  EquationsOfMotion equations(system);
  const VectorXd absolute = descriptor_state(system, dynamics);
  const auto velocities = absolute.segment(system.position_count, system.velocity_count);
  equations.set_positions(0, absolute.head(system.position_count));
  equations.set_velocities(velocities);
  equations.solve();
  equations.update_idle_markers(velocities);
  for (std::size_t k = 0; k < model.markers.size(); ++k) {
    CAPTURE(model.markers[k].name);
    MarkerState found;
    dynamics.marker_state(k, found);
    const NodeKinematics& expected = equations.marker(k);
    Eigen::Vector3d acceleration = expected.gp;
    Eigen::Vector3d angular_acceleration = expected.gr;
    if (const std::size_t b = system.markers[k].free_body; b != JointPlace::kNoBody) {
      const auto rates =
          equations.accelerations().segment(system.bodies[b].velocity, expected.P.cols());
      acceleration += expected.P * rates;
      angular_acceleration += expected.W * rates;
    }
    CHECK((found.position_m - expected.p).norm() < 1e-14);
    CHECK((found.rotation - expected.R).norm() < 1e-14);
    CHECK((found.velocity_m_s - expected.pd).norm() < 1e-13);
    CHECK((found.angular_velocity_rad_s - expected.Om).norm() < 1e-13);
    CHECK((found.acceleration_m_s2 - acceleration).norm() < kAgreement * 1e3);
    CHECK((found.angular_acceleration_rad_s2 - angular_acceleration).norm() <
          kAgreement * std::max(1e3, angular_acceleration.norm()));
  }
  Energies expected;
  expected.strain_J = equations.forces().stored_J();
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const FreeBody& body = system.bodies[b];
    const auto V = velocities.segment(body.velocity, body.constants.velocity_count());
    expected.kinetic_J += kinetic_energy_J(equations.body(b), V);
    expected.gravitational_J +=
        gravitational_energy_J(body.constants, model.gravity_m_s2, equations.body(b));
    expected.strain_J += body.constants.springs.energy_J(equations.body(b).a);
  }
  const Energies found = dynamics.energies();
  CHECK(found.kinetic_J == Approx(expected.kinetic_J).epsilon(kAgreement));
  CHECK(found.gravitational_J == Approx(expected.gravitational_J).epsilon(kAgreement));
  CHECK(found.strain_J == Approx(expected.strain_J).epsilon(kAgreement));
}

TEST_CASE("a tree's joint coordinates are found again from the motion of its bodies") {
  const Model model = any_model();
  const tree::Tree tree(model);
  tree::TreeDynamics dynamics(tree);
  VectorXd state = random_state(tree);
  state.tail<tree::Tree::kQuadratures>().setZero();
  dynamics.update(0, state);
  dynamics.solve();
  std::vector<BodyState> bodies;
  for (std::size_t b = 0; b < tree.bodies.size(); ++b) bodies.push_back(dynamics.body_state(b));
  VectorXd found = state_of(tree, bodies);
  for (const tree::TreeBody& body : tree.bodies) {
    // A rotation has two quaternions; either is right.
    const Index nq = body.joint.position_count();
    if (nq == body.joint.velocity_count()) continue;
    auto q = found.segment<4>(body.position + nq - 4);
    if (q.dot(state.segment<4>(body.position + nq - 4)) < 0) q = -q;
  }
  CHECK((found - state).lpNorm<Eigen::Infinity>() < 1e-13);
}

TEST_CASE("a tree's error is measured where it is, in units of what each part tolerates") {
  const Model model = forest();
  const tree::Tree tree(model);
  constexpr double kRelative = 1e-3;
  constexpr double kAbsolute = 1e-6;
  const tree::TreeError measure(tree, kRelative, kAbsolute);
  const VectorXd state = random_state(tree);
  double speed = 0;
  for (const tree::TreeBody& body : tree.bodies) {
    const Index n = body.joint.law->distances;
    const auto rates =
        state.segment(tree.position_count + body.velocity, body.joint.velocity_count());
    speed =
        std::max({speed, rates.head(n).norm(), tree.size_m * rates.tail(rates.size() - n).norm()});
  }
  constexpr double kError = 1e-5;
  for (const tree::TreeBody& body : tree.bodies) {
    const Index n = body.joint.law->distances;
    const auto name = body.joint_index == tree::kNone
                          ? "body '" + body.name + "'"
                          : "joint '" + model.joints[body.joint_index].name + "'";
    const auto check = [&](Index place, double size, double reference, const std::string& part) {
      CAPTURE(name, part);
      VectorXd error = VectorXd::Zero(state.size());
      error[place] = kError;
      const ErrorEstimate found = measure(state, state, error);
      CHECK(found.value ==
            Approx(size * kError / (kAbsolute + kRelative * reference)).epsilon(1e-12));
      CHECK(measure.name_of(found.component) == part + " of " + name);
    };
    const Index u = tree.position_count + body.velocity;
    if (n > 0) check(body.position, 1, tree.size_m, "position");
    if (n > 0) check(u, 1, speed, "rate");
    const Index nu = body.joint.velocity_count();
    // A quaternion changes by half the angle.
    if (nu > n) check(body.position + n, body.joint.law->has_quaternion ? 2 : 1, 1, "position");
    if (nu > n) check(u + n, tree.size_m, speed, "rate");
  }
}

TEST_CASE("the recursive formulation refuses a loop and names a joint that closes it") {
  Model model = forest();
  model.joints.push_back(
      {"bar", &kSphericalJoint, model.marker_index("d end"), model.marker_index("f e")});
  CHECK_FALSE(tree::is_tree(model));
  try {
    const tree::Tree tree(model);
    FAIL("a loop was taken for a tree");
  } catch (const flexneck::InputError& error) {
    const std::string message = error.what();
    CHECK(message.find("joint '") == 0);
    CHECK(message.find("closes a loop") != std::string::npos);
    CHECK(message.find("descriptor") != std::string::npos);
  }
}
