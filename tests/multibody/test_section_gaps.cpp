// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "multibody/forces/section.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/numerics/rotation.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/point_mass_body.h"
#include "tests/support/test_models.h"

using Catch::Matchers::Contains;
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using namespace flexneck::multibody;
using namespace flexneck::testing;
using Vector6d = Eigen::Matrix<double, 6, 1>;

namespace {

Section::Stiffness random_stiffness(RandomNumbers& random, Index gaps) {
  MatrixXd root(6 + gaps, 6 + gaps);
  random.fill(root);
  return 3 * (root * root.transpose() + 0.1 * MatrixXd::Identity(6 + gaps, 6 + gaps));
}

Section random_section(RandomNumbers& random, Index gaps) {
  Section section{"slit", 0, 1, {0.03, -0.02, 0.2}, random_stiffness(random, gaps)};
  section.branches = {{random_stiffness(random, gaps), 0.03},
                      {random_stiffness(random, gaps), 0.2}};
  return section;
}

double energy(const Section& section, const Section::Strain& strain, const VectorXd& dashpots) {
  double sum = strain.dot(section.stiffness * strain) / 2;
  for (std::size_t b = 0; b < section.branches.size(); ++b) {
    const Index size = section.branch_size();
    const Section::Strain spring = strain - dashpots.segment(static_cast<Index>(b) * size, size);
    sum += spring.dot(section.branches[b].stiffness * spring) / 2;
  }
  return sum;
}

InternalVariables given(const VectorXd& dashpots) {
  InternalVariables internal;
  internal.known = InternalVariables::Known::now;
  internal.values = dashpots.data();
  return internal;
}

}  // namespace

TEST_CASE("gaps open to the least energy, whatever the motion and the dashpots are") {
  RandomNumbers random(33);
  for (int trial = 0; trial < 2000; ++trial) {
    const Index gaps = 1 + trial % Section::kMaxGaps;
    const Section section = random_section(random, gaps);
    const Vector6d e = random.vector(6);
    const VectorXd dashpots = random.vector(2 * section.branch_size());
    int open = 0;
    const Section::Strain strain = section.with_gaps(e, given(dashpots), open);
    REQUIRE(strain.tail(gaps).minCoeff() >= 0);
    const double least = energy(section, strain, dashpots);
    for (int other = 0; other < 10; ++other) {
      Section::Strain moved = strain;
      const double step = std::pow(10.0, -other);
      moved.tail(gaps) = (strain.tail(gaps) + step * random.vector(gaps)).cwiseMax(0.0);
      REQUIRE(energy(section, moved, dashpots) >= least * (1 - 1e-14));
    }
    // The bits say which gaps are open.
    for (Index k = 0; k < gaps; ++k) REQUIRE((open >> k & 1) == (strain[6 + k] > 0 ? 1 : 0));
  }
}

TEST_CASE("with gaps and dashpots, too, a section's load is the gradient of its energy") {
  RandomNumbers random(34);
  int opened = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Section section = random_section(random, 2);
    const VectorXd dashpots = 0.3 * random.vector(2 * section.branch_size());
    MarkerKinematics i, j;
    i.R = random.rotation().toRotationMatrix();
    j.p = 0.3 * random.vector();
    j.R = random.rotation().toRotationMatrix();
    const auto act = [&](const MarkerKinematics& at) {
      ForceLoad load;
      ForceEnergies sums;
      section.act({i, at, {}, {}, 0, given(dashpots)}, load, sums);
      return std::pair(sums.stored_J, load);
    };
    const ForceLoad load = act(j).second;
    opened += load.piece.deflection != 0 ? 1 : 0;
    constexpr double kStep = 1e-6;
    for (Index axis = 0; axis < 3; ++axis) {
      const auto energy_at = [&](double moved, double turned) {
        MarkerKinematics at = j;
        at.p += moved * Vector3d::Unit(axis);
        at.R = rotation_exp(turned * Vector3d::Unit(axis)) * at.R;
        return act(at).first;
      };
      CHECK(load.force_N[axis] ==
            Approx((energy_at(-kStep, 0) - energy_at(kStep, 0)) / (2 * kStep)).margin(1e-5));
      CHECK(load.moment_Nm[axis] ==
            Approx((energy_at(0, -kStep) - energy_at(0, kStep)) / (2 * kStep)).margin(1e-5));
    }
  }
  CHECK(opened > 5);
  CHECK(opened < 20);
}

TEST_CASE("a block on a slit swings half a period on the open and half on the closed stiffness") {
  // The gap opens as the block moves ahead: K = [k, -c; -c, k_g], stiffness k - c^2 / k_g if open.
  constexpr double kMass = 1.5;
  constexpr double kClosed = 700;
  constexpr double kCoupling = 300;
  constexpr double kGap = 200;
  constexpr double kSpeed = 2;
  ModelBuilder build;
  const auto ground = build.marker("ground", build.ground());
  const auto block = build.marker(
      "block", build.body("block", RigidBody{kMass, Vector3d::Zero(), Matrix3d::Identity()}, {},
                          {kSpeed, 0, 0}));
  build.joint("slide", &kPrismaticJoint, ground, block, Vector3d::UnitX());
  Section section{"slit", ground, block, Vector3d::Zero(), MatrixXd::Zero(7, 7)};
  section.stiffness(0, 0) = kClosed;
  section.stiffness(0, 6) = section.stiffness(6, 0) = -kCoupling;
  section.stiffness(6, 6) = kGap;
  build.model.forces.add(section);
  const double open_half =
      std::numbers::pi * std::sqrt(kMass / (kClosed - kCoupling * kCoupling / kGap));
  const double closed_half = std::numbers::pi * std::sqrt(kMass / kClosed);
  const double period = open_half + closed_half;
  const History history = simulate(build.model, solver_of(1e-10, 1e-12),
                                   {.end_time_s = 5 * period, .interval_s = period});
  const auto& moved = history.marker("block");
  for (Index k = 0; k <= 5; ++k) {
    CHECK(std::abs(moved.position_m(0, k)) < 1e-8);
    CHECK(moved.velocity_m_s(0, k) == Approx(kSpeed).epsilon(1e-8));
  }
  CHECK(history.energy.strain_J.cwiseAbs().maxCoeff() < 1e-7);
  // Events end steps: an even number of openings and closings in each period.
  const auto& limits = history.statistics.limits;
  const auto events = std::find_if(limits.begin(), limits.end(), [](const auto& each) {
    return each.what.find("a gap opens or closes") != std::string::npos;
  });
  REQUIRE(events != limits.end());
  CHECK(events->steps >= 9);
}

TEST_CASE(
    "gaps that open and close, with relaxation, never raise the energy of motion and strain") {
  RandomNumbers random(35);
  ModelBuilder build;
  const auto plate =
      build.body("plate", RigidBody{1, Vector3d::Zero(), 0.01 * Matrix3d::Identity()},
                 {{0.03, -0.02, 0.2}}, {1, -2, 1}, {8, -9, 5});
  Section section = random_section(random, 2);
  section.marker_i = build.marker("ground", build.ground());
  section.marker_j = build.marker("plate", plate);
  build.model.forces.add(section);
  const auto run = [&](Integrator integrator, double tolerance) {
    SolverOptions solver = solver_of(tolerance, 1e-3 * tolerance);
    solver.integrator = integrator;
    return simulate(build.model, solver, {.end_time_s = 2, .interval_s = 2e-3});
  };
  const History found = run(Integrator::dormand_prince, 1e-10);
  const VectorXd energy = found.energy.kinetic_J + found.energy.strain_J;
  const VectorXd books = energy + found.energy.dissipated_J;
  CHECK((books.array() - books[0]).abs().maxCoeff() < 1e-8 * books[0]);
  CHECK((energy.tail(energy.size() - 1) - energy.head(energy.size() - 1)).maxCoeff() <
        1e-9 * books[0]);
  CHECK(energy[energy.size() - 1] < 0.5 * energy[0]);
  const History implicit = run(Integrator::generalised_alpha, 1e-7);
  CHECK((implicit.marker("plate").position_m - found.marker("plate").position_m)
            .cwiseAbs()
            .maxCoeff() < 1e-4);
}

TEST_CASE("gaps that make no sense are refused") {
  RandomNumbers random(36);
  ModelBuilder build;
  const auto plate = build.body("plate", RigidBody{1, Vector3d::Zero(), Matrix3d::Identity()});
  const auto ground = build.marker("ground", build.ground());
  const auto top = build.marker("plate", plate);
  const auto refused = [&](Section section, const char* message) {
    section.marker_i = ground;
    section.marker_j = top;
    Model model = build.model;
    model.forces.add(section);
    CHECK_THROWS_WITH(simulate(model, {}, {.end_time_s = 1, .interval_s = 1}),
                      Contains("section 'slit'") && Contains(message));
  };
  Section section = random_section(random, 2);
  section.stiffness.row(7).setZero();
  section.stiffness.col(7).setZero();
  refused(section, "stiffness of the gaps and of the sliding motions must be positive definite");
  section = random_section(random, 2);
  section.branches[1].stiffness = random_stiffness(random, 1);
  refused(section, "stiffness of branch 2 must be of the same size");
}
