// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "multibody/analysis/linearisation.h"
#include "multibody/forces/section.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/point_mass_body.h"
#include "tests/support/sections.h"
#include "tests/support/test_models.h"

using Catch::Matchers::Contains;
using Eigen::Vector3d;
using Eigen::VectorXd;
using namespace flexneck::multibody;
using namespace flexneck::testing;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

namespace {

/// A block on a slide, connected to the ground by a section along x that relaxes.
struct RelaxingOscillator {
  double mass_kg = 2;
  double slow_N_m = 300;  ///< stiffness of slow motions
  std::vector<std::pair<double, double>> branches = {{500, 0.05}, {200, 0.4}};  ///< N/m, s

  Model model(double velocity_m_s) const {
    ModelBuilder build;
    const auto ground = build.ground();
    const auto block = build.body("block", ball(mass_kg, 1), {}, {velocity_m_s, 0, 0});
    const auto at_ground = build.marker("ground", ground);
    const auto at_block = build.marker("block", block);
    build.joint("slide", &kPrismaticJoint, at_ground, at_block, Vector3d::UnitX());
    Section section{"rubber", at_ground, at_block};
    section.stiffness(0, 0) = slow_N_m;
    for (const auto& [stiffness, time] : branches) {
      Section::Branch branch{Matrix6d::Zero(), time};
      branch.stiffness(0, 0) = stiffness;
      section.branches.push_back(branch);
    }
    build.model.forces.add(section);
    return build.model;
  }

  /// System matrix of x'' = -(slow x + sum k (x - z)) / m, z' = (x - z) / tau.
  Eigen::MatrixXd matrix() const {
    const auto n = static_cast<Eigen::Index>(branches.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 + n, 2 + n);
    A(0, 1) = 1;
    A(1, 0) = -slow_N_m / mass_kg;
    for (Eigen::Index b = 0; b < n; ++b) {
      const auto& [stiffness, time] = branches[static_cast<std::size_t>(b)];
      A(1, 0) -= stiffness / mass_kg;
      A(1, 2 + b) = stiffness / mass_kg;
      A(2 + b, 0) = 1 / time;
      A(2 + b, 2 + b) = -1 / time;
    }
    return A;
  }

  /// Position of the block, started with the given velocity and relaxed branches.
  double position_m(double velocity_m_s, double time_s) const {
    const Eigen::EigenSolver<Eigen::MatrixXd> eigen(matrix());
    const Eigen::VectorXcd start =
        VectorXd(velocity_m_s * VectorXd::Unit(matrix().rows(), 1)).cast<std::complex<double>>();
    Eigen::VectorXcd amplitudes = eigen.eigenvectors().inverse() * start;
    for (Eigen::Index k = 0; k < amplitudes.size(); ++k)
      amplitudes[k] *= std::exp(eigen.eigenvalues()[k] * time_s);
    return (eigen.eigenvectors().row(0) * amplitudes).value().real();
  }
};

/// Two tumbling bodies, connected by a section with a branch, the first also by another one to a
/// moving sled.
Model tumbling_pair() {
  RandomNumbers random(91);
  ModelBuilder build;
  const auto section = [&](const char* name, std::size_t i, std::size_t j) {
    Section each{name, i, j, {0.02, -0.01, 0.1}, 0.05 * random_stiffness(random)};
    each.branches = {{0.05 * random_stiffness(random), 0.03},
                     {0.05 * random_stiffness(random), 0.2}};
    build.model.forces.add(each);
  };
  PrescribedBody sled;
  sled.initial_velocity_m_s = 0.5;
  const auto carrier = build.body("sled", sled);
  const auto a = build.body("a", ball(1.5, 0.01), {{0.02, 0, 0.1}}, {0.4, 1, 0}, {20, -9, 4});
  const auto b = build.body("b", ball(1, 0.02), {{0.03, 0, 0.2}}, {0, -1, 0.5}, {-9, 20, 8});
  section("lower", build.marker("sled", carrier), build.marker("a", a));
  section("upper", build.marker("a top", a, {0, 0, 0.01}), build.marker("b", b, {0, 0.01, 0}));
  return build.model;
}

}  // namespace

TEST_CASE("a block on a section that relaxes moves as its linear equations say") {
  const RelaxingOscillator oscillator;
  constexpr double kVelocity = 3;
  SolverOptions solver = solver_of(1e-10, 1e-12);
  double tolerance = 1e-8;
  SECTION("explicitly") {}
  SECTION("implicitly") {
    solver.integrator = Integrator::generalised_alpha;
    solver.relative_tolerance = 1e-8;
    solver.absolute_tolerance = 1e-10;
    tolerance = 1e-5;
  }
  const History history =
      simulate(oscillator.model(kVelocity), solver, {.end_time_s = 1, .interval_s = 0.1});
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k)
    CHECK(std::abs(history.marker("block").position_m(0, k) -
                   oscillator.position_m(kVelocity, history.time_s[k])) < tolerance);
  const double lost = history.energy.dissipated_J[10];
  const double begin = 0.5 * oscillator.mass_kg * kVelocity * kVelocity;
  CHECK(lost > 0.5 * begin);
  CHECK(history.energy.kinetic_J[10] + history.energy.strain_J[10] + lost ==
        Approx(begin).epsilon(10 * tolerance));
}

TEST_CASE("the frequency and damping of relaxing sections are those of their eigenvalues") {
  RelaxingOscillator oscillator;
  const int branches = GENERATE(1, 2);
  oscillator.branches.resize(static_cast<std::size_t>(branches));
  const auto at = GENERATE(LinearisedAt::equilibrium, LinearisedAt::given);
  const Eigen::VectorXcd eigenvalues = oscillator.matrix().eigenvalues();
  const auto* pair = std::max_element(
      eigenvalues.data(), eigenvalues.data() + eigenvalues.size(),
      [](std::complex<double> a, std::complex<double> b) { return a.imag() < b.imag(); });
  const std::vector<ModeShape> modes = linearise(oscillator.model(0), at);
  REQUIRE(modes.size() == 1);
  CHECK(modes[0].mode.frequency_Hz ==
        Approx(std::abs(*pair) / (2 * std::numbers::pi)).epsilon(1e-8));
  CHECK(modes[0].mode.damping_ratio == Approx(-pair->real() / std::abs(*pair)).epsilon(1e-8));
}

TEST_CASE("bodies on relaxing sections keep the books of energy through large rotations") {
  const Model model = tumbling_pair();
  const auto run = [&](Formulation formulation, Integrator integrator, double tolerance) {
    SolverOptions solver;
    solver.relative_tolerance = tolerance;
    solver.absolute_tolerance = 1e-3 * tolerance;
    solver.formulation = formulation;
    solver.integrator = integrator;
    return simulate(model, solver, {.end_time_s = 0.5, .interval_s = 0.05});
  };
  const History found = run(Formulation::descriptor, Integrator::dormand_prince, 1e-10);
  const VectorXd books = found.energy.kinetic_J + found.energy.strain_J +
                         found.energy.dissipated_J - found.energy.work_J;
  CHECK((books.array() - books[0]).abs().maxCoeff() < 1e-8 * books[0]);
  CHECK(found.energy.dissipated_J[10] > 0.1 * books[0]);
  CHECK(found.marker("b").rotation.row(0).cwiseAbs().minCoeff() < 0.95);
  const auto distance = [&](const History& other) {
    return (other.marker("b").position_m - found.marker("b").position_m).cwiseAbs().maxCoeff();
  };
  CHECK(distance(run(Formulation::recursive, Integrator::dormand_prince, 1e-10)) < 1e-8);
  const double coarse = distance(run(Formulation::recursive, Integrator::generalised_alpha, 1e-5));
  const double fine = distance(run(Formulation::descriptor, Integrator::generalised_alpha, 1e-7));
  CHECK(coarse < 1e-3);
  CHECK(fine < 0.1 * coarse);
}

TEST_CASE("bodies that hang on sections alone start from equilibrium with what carries them") {
  Model model = tumbling_pair();
  model.gravity_m_s2 = {0, 0, -0.5};
  const History history = simulate_from_equilibrium(model, solver_of(1e-9, 1e-12),
                                                    {.end_time_s = 0.4, .interval_s = 0.1});
  const auto& moved = history.marker("b").position_m;
  CHECK((moved.col(4) - moved.col(0) - Vector3d(0.2, 0, 0)).norm() < 1e-7);
  CHECK(history.energy.dissipated_J[4] < 1e-9);
  model.forces.of<Section>().pop_back();
  CHECK_THROWS_WITH(simulate_from_equilibrium(model, {}, {.end_time_s = 1, .interval_s = 1}),
                    Contains("body 'b'") && Contains("no joint or section"));
}

TEST_CASE("a section that makes no sense is refused") {
  const RelaxingOscillator oscillator;
  const auto refused = [&](auto spoil, const char* message) {
    Model model = oscillator.model(1);
    spoil(model.forces.of<Section>().front());
    CHECK_THROWS_WITH(simulate(model, {}, {.end_time_s = 1, .interval_s = 1}),
                      Contains("section 'rubber'") && Contains(message));
  };
  refused([](Section& s) { s.stiffness(0, 1) = 1; }, "stiffness must be symmetric");
  refused([](Section& s) { s.branches[1].relaxation_time_s = 0; },
          "relaxation time of branch 2 must be positive");
  refused([](Section& s) { s.branches[0].stiffness(0, 0) = -1; }, "stiffness of branch 1");
  refused([](Section& s) { s.marker_j = s.marker_i; }, "both markers are on body");
}
