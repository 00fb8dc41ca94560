// SPDX-License-Identifier: GPL-3.0-or-later
// Tests of slits of a deformable body.
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <catch2/catch.hpp>

#include "multibody/analysis/linearisation.h"
#include "multibody/forces/least_gaps.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/point_mass_body.h"
#include "tests/support/test_models.h"

using Catch::Matchers::Contains;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using namespace flexneck::multibody;
using namespace flexneck::testing;

namespace {

MatrixXd random_stiffness(RandomNumbers& random, Index size) {
  MatrixXd root(size, size);
  random.fill(root);
  return root * root.transpose() + 0.05 * MatrixXd::Identity(size, size);
}

/// A body with gaps that reduce the modes' stiffness considerably where they open.
DeformableBody slit_body(RandomNumbers& random, Index gaps) {
  DeformableBody body = deformable(make_point_mass_body(51, 3).body, 0);
  const VectorXd omega = 2 * std::numbers::pi * body.modes.frequencies_Hz;
  body.gaps.stiffness = random_stiffness(random, gaps);
  const Eigen::LLT<MatrixXd> root(body.gaps.stiffness);
  MatrixXd shares(gaps, 3);
  random.fill(shares);
  shares *= 0.9 / shares.norm();
  body.gaps.coupling = root.matrixL() * shares * omega.asDiagonal();
  return body;
}

constexpr double kTaken = 0.4;  // fraction of the stiffness lost by the open slit

/// A body of one mode of 3 Hz, whose slit opens as its coordinate grows, clamped to the ground.
Model clamped_slit_body(double coordinate, double rate) {
  ModelBuilder build;
  DeformableBody body = deformable(make_point_mass_body(54, 1).body, 0);
  body.modes.frequencies_Hz[0] = 3;
  body.gaps.stiffness = MatrixXd::Constant(1, 1, 7);
  const double omega = 2 * std::numbers::pi * 3;
  body.gaps.coupling = MatrixXd::Constant(1, 1, -omega * std::sqrt(7 * kTaken));
  body.initial_modal = VectorXd::Constant(1, coordinate);
  body.initial_modal_rate = VectorXd::Constant(1, rate);
  const auto ground = build.marker("ground", build.ground());
  const auto root = build.interface_marker("root", build.body("body", body), "root");
  build.joint("clamp", &kFixedJoint, ground, root);
  return build.model;
}

}  // namespace

TEST_CASE("openings are the least of their energy, as among all choices of open ones") {
  RandomNumbers random(52);
  for (int trial = 0; trial < 2000; ++trial) {
    const MatrixXd A = random_stiffness(random, 4);
    const VectorXd r = random.vector(4);
    const LeastGaps<4> all(A, r, 0);
    const VectorXd g = least_openings(A, r);
    REQUIRE((g - all.openings_m).norm() < 1e-9 * (1 + g.norm()));
  }
}

TEST_CASE("a body on one mode swings half a period with its slit shut, and half with it open") {
  const double period = 1.0 / 6 * (1 + 1 / std::sqrt(1 - kTaken));
  const History history = simulate(clamped_slit_body(0, 0.01), solver_of(1e-9, 1e-13),
                                   {.end_time_s = 4 * period, .interval_s = period / 2});
  for (Index k = 0; k <= 8; k += 2)
    CHECK(std::abs(history.modal.front().coordinates(0, k)) < 1e-7 * 0.01);
  CHECK(history.energy.strain_J[0] == 0);
}

TEST_CASE("small motions about a slit that is just shut have the mean stiffness, and say so") {
  const auto mode_at = [](double coordinate, LinearisedAt at) {
    Model model = clamped_slit_body(coordinate, 0);
    model.gravity_m_s2.setZero();
    return linearise(model, at).front().mode;
  };
  for (const LinearisedAt at : {LinearisedAt::equilibrium, LinearisedAt::given}) {
    const SystemMode just_shut = mode_at(0, at);
    CHECK(just_shut.frequency_Hz == Approx(3 * std::sqrt(1 - kTaken / 2)).epsilon(1e-9));
    CHECK(just_shut.kink == "body 'body': a slit opens or closes");
  }
  const SystemMode open = mode_at(0.01, LinearisedAt::given);
  CHECK(open.frequency_Hz == Approx(3 * std::sqrt(1 - kTaken)).epsilon(1e-9));
  CHECK(open.kink.empty());
  const SystemMode shut = mode_at(-0.01, LinearisedAt::given);
  CHECK(shut.frequency_Hz == Approx(3).epsilon(1e-9));
  CHECK(shut.kink.empty());
}

TEST_CASE("a body with slits keeps its energy, and both formulations agree") {
  RandomNumbers random(55);
  const auto run = [&](Formulation formulation) {
    RandomNumbers same(56);
    ModelBuilder build;
    DeformableBody body = slit_body(same, 3);
    body.initial_modal = 0.02 * same.vector(3);
    const auto ground = build.marker("ground", build.ground());
    const auto root = build.interface_marker("root", build.body("body", body), "root");
    build.interface_marker("tip", build.model.markers[root].body, "tip");
    build.joint("pin", &kRevoluteJoint, ground, root);
    build.model.gravity_m_s2 = {0, 0, -kGravity};
    SolverOptions solver{.relative_tolerance = 1e-9, .absolute_tolerance = 1e-12};
    solver.formulation = formulation;
    return simulate(build.model, solver, {.end_time_s = 0.3, .interval_s = 1e-3});
  };
  const History tree = run(Formulation::recursive);
  const History all = run(Formulation::descriptor);
  CHECK((tree.marker("tip").position_m - all.marker("tip").position_m).cwiseAbs().maxCoeff() <
        1e-7);
  const EnergyHistory& energy = tree.energy;
  const VectorXd sum = energy.kinetic_J + energy.strain_J + energy.gravitational_J;
  CHECK((sum.array() - sum[0]).abs().maxCoeff() < 1e-6 * energy.strain_J[0]);
  CHECK(energy.strain_J.minCoeff() >= 0);
}

TEST_CASE("gaps that do not fit a body are refused") {
  RandomNumbers random(57);
  const auto refused = [&](const DeformableBody& body, const char* message) {
    ModelBuilder build;
    build.body("body", body);
    CHECK_THROWS_WITH(check(build.model), Contains("body 'body'") && Contains(message));
  };
  DeformableBody body = slit_body(random, 2);
  body.gaps.coupling.conservativeResize(2, 2);
  refused(body, "do not have the sizes");
  body = slit_body(random, 2);
  body.gaps.coupling *= 2;
  refused(body, "not positive definite");
  body = slit_body(random, 2);
  body.stress_stiffening = true;
  refused(body, "stress_stiffening is not supported");
}
