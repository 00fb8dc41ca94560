// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "multibody/forces/section.h"
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

Section::Stiffness random_stiffness(RandomNumbers& random, Index size) {
  MatrixXd root(size, size);
  random.fill(root);
  return 3 * (root * root.transpose() + 0.1 * MatrixXd::Identity(size, size));
}

Section random_section(RandomNumbers& random, Index gaps, Index slides) {
  const Index size = 6 + gaps + slides;
  Section section{"slit", 0, 1, {0.03, -0.02, 0.2}, random_stiffness(random, size)};
  section.branches = {{random_stiffness(random, size), 0.03}};
  section.friction = {slides, 0.5, 0.005};
  return section;
}

/// Response of a section with memory to a position of its top.
class Acting {
 public:
  explicit Acting(const Section& section)
      : section_(section),
        internal(
            VectorXd::Zero(static_cast<Index>(section.branch_count()) * section.branch_size())),
        rates(internal) {}

  /// @param length_s  duration of a step from the present to this position; 0: the memory is kept
  void to(const MarkerKinematics& top, double length_s) {
    std::vector<BranchStep> steps;
    for (std::size_t b = 0; b < section_.branch_count(); ++b)
      steps.push_back(BranchStep::over(length_s, section_.relaxation_time_s(b)));
    VectorXd found = internal;
    VectorXd found_rates = rates;
    InternalVariables known;
    known.known = length_s > 0 ? InternalVariables::Known::begin : InternalVariables::Known::now;
    known.values = internal.data();
    known.rates = rates.data();
    known.steps = steps.data();
    known.found_values = found.data();
    known.found_rates = found_rates.data();
    load = {};
    sums = {};
    section_.act({MarkerKinematics{}, top, {}, {}, 0, known}, load, sums);
    internal = found;
    rates = found_rates;
  }

 private:
  const Section& section_;

 public:
  VectorXd internal, rates;
  ForceLoad load;
  ForceEnergies sums;
};

MarkerKinematics at(const Vector3d& place) {
  MarkerKinematics marker;
  marker.p = place;
  return marker;
}

MarkerKinematics random_place(RandomNumbers& random) {
  MarkerKinematics marker;
  marker.p = 0.3 * random.vector();
  marker.R = random.rotation().toRotationMatrix();
  return marker;
}

}  // namespace

TEST_CASE("shut sides stick below mu N, and a cycle beyond takes 4 mu N (X - mu N / k)") {
  // A spring k along x in series with the sides, pressed by k_n along z.
  constexpr double k = 4e4;
  constexpr double k_n = 9e5;
  constexpr double kPressed = 2e-4;
  constexpr double kAlone = 1e4;  // a spring beside them
  Section section{"slit", 0, 1, Vector3d::Zero(), MatrixXd::Zero(8, 8)};
  section.stiffness(0, 0) = k + kAlone;
  section.stiffness(7, 7) = k;
  section.stiffness(0, 7) = section.stiffness(7, 0) = -k;
  section.stiffness(2, 2) = k_n;
  section.stiffness(6, 6) = 1.001 * k_n;
  section.stiffness(2, 6) = section.stiffness(6, 2) = -k_n;
  section.friction = {1, 0.3, 1e-6};
  const double most_N = 0.3 * k_n * kPressed;

  const auto loss_of_cycle = [&](double largest_m) {
    constexpr int kQuarter = 500;
    Acting slit(section);
    double work_J = 0;
    double before_m = 0;
    double before_N = 0;
    for (int step = 1; step <= 9 * kQuarter; ++step) {
      const double phase = static_cast<double>(step) / kQuarter;  // a triangle, four a period
      const double x = largest_m * (1 - std::abs(std::fmod(phase + 1, 4) - 2));
      slit.to(at({x, 0, -kPressed}), 1e-3);
      const double force_N = -slit.load.force_N.x();
      if (step > 5 * kQuarter) work_J += (force_N + before_N) / 2 * (x - before_m);
      before_m = x;
      before_N = force_N;
    }
    return work_J;
  };
  CHECK(std::abs(loss_of_cycle(0.999 * most_N / k)) < 1e-12);
  const double largest_m = 3 * most_N / k;
  CHECK(loss_of_cycle(largest_m) == Approx(4 * most_N * (largest_m - most_N / k)).epsilon(1e-3));

  // Once open, the sides are free.
  Acting slit(section);
  slit.to(at({largest_m, 0, -kPressed}), 1e-3);
  slit.to(at({largest_m, 0, kPressed}), 1e-3);
  CHECK(slit.internal[15 - 8] == Approx(largest_m).epsilon(1e-2));
}

TEST_CASE("friction takes energy and gives none, whatever the state") {
  RandomNumbers random(41);
  int slipped = 0;
  int shut = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Section section = random_section(random, 1 + trial % 2, 1 + trial % 3);
    const Index size = section.branch_size();
    Acting slit(section);
    slit.internal = 0.3 * random.vector(2 * size);
    slit.internal.tail(size).head(size - section.friction.slides).setZero();
    const MarkerKinematics place = random_place(random);
    slit.to(place, 0);
    const double before_J = slit.sums.stored_J;
    REQUIRE(slit.sums.lost_W >= 0);
    slipped += slit.load.piece.rate % 2;
    shut += slit.load.piece.deflection == 0 ? 1 : 0;
    // At a fixed position it loses energy over steps of any length, and no more than it had.
    for (const double length_s : {1e-5, 1e-3, 0.1, 10.}) {
      const double stored_J = slit.sums.stored_J;
      slit.to(place, length_s);
      REQUIRE(slit.sums.stored_J <= stored_J + 1e-12 * before_J);
      REQUIRE(slit.sums.lost_W >= 0);
    }
  }
  CHECK(slipped > 100);
  CHECK(slipped < 900);
  CHECK(shut > 100);
}

TEST_CASE("a slit with friction ends on the bounds of its law: stuck, or slipping at mu N") {
  RandomNumbers random(42);
  int stuck = 0;
  int slips = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Section section = random_section(random, 1 + trial % 2, 1);
    section.branches.clear();
    section.friction.sliding_time_s = 1e-9;
    const Index size = section.branch_size();
    const Index gaps = section.gap_count();
    Acting slit(section);
    const MarkerKinematics place = random_place(random);
    slit.to(place, 0);
    Section frictionless = section;
    frictionless.friction.coefficient = 0;
    Acting free(frictionless);
    free.to(place, 1);
    slit.to(place, 1);
    CHECK(free.sums.stored_J <= slit.sums.stored_J * (1 + 1e-12));
    const double s = slit.internal[size - 1];
    if (slit.load.piece.deflection != (1 << gaps) - 1) (s == 0 ? stuck : slips) += 1;
    // If it is wholly open, it is where no load acts on it.
    if (slit.load.piece.deflection == (1 << gaps) - 1)
      CHECK(slit.sums.stored_J == Approx(free.sums.stored_J).epsilon(1e-7));
  }
  CHECK(stuck > 10);
  CHECK(slips > 10);
}

TEST_CASE("with friction in its slit a plate's energy never rises, and the books close") {
  RandomNumbers random(43);
  ModelBuilder build;
  const auto plate =
      build.body("plate", RigidBody{1, Vector3d::Zero(), 0.01 * Eigen::Matrix3d::Identity()},
                 {{0.03, -0.02, 0.2}}, {1, -2, 1}, {8, -9, 5});
  Section section = random_section(random, 2, 2);
  section.marker_i = build.marker("ground", build.ground());
  section.marker_j = build.marker("plate", plate);
  build.model.forces.add(section);
  const auto run = [&](Integrator integrator, double tolerance) {
    SolverOptions solver = solver_of(tolerance, 1e-3 * tolerance);
    solver.integrator = integrator;
    return simulate(build.model, solver, {.end_time_s = 1, .interval_s = 2e-3});
  };
  const History found = run(Integrator::dormand_prince, 1e-9);
  const VectorXd energy = found.energy.kinetic_J + found.energy.strain_J;
  const VectorXd books = energy + found.energy.dissipated_J;
  CHECK((books.array() - books[0]).abs().maxCoeff() < 1e-7 * books[0]);
  CHECK((energy.tail(energy.size() - 1) - energy.head(energy.size() - 1)).maxCoeff() <
        1e-8 * books[0]);
  CHECK(energy[energy.size() - 1] < 0.7 * energy[0]);
  const History implicit = run(Integrator::generalised_alpha, 1e-7);
  CHECK((implicit.marker("plate").position_m - found.marker("plate").position_m)
            .cwiseAbs()
            .maxCoeff() < 1e-3);
}

TEST_CASE("friction that makes no sense is refused") {
  RandomNumbers random(44);
  ModelBuilder build;
  const auto plate =
      build.body("plate", RigidBody{1, Vector3d::Zero(), Eigen::Matrix3d::Identity()});
  const auto ground = build.marker("ground", build.ground());
  const auto top = build.marker("plate", plate);
  const auto refused = [&](Section section, const char* message) {
    section.marker_i = ground;
    section.marker_j = top;
    Model model = build.model;
    model.forces.add(section);
    CHECK_THROWS_WITH(simulate(model, {}, {.end_time_s = 1, .interval_s = 1}),
                      Contains("section 'slit'") && Contains(message));
    CHECK_THROWS_WITH(settle(model, {}, {.end_time_s = 1, .interval_s = 1}),
                      Contains("section 'slit'"));
  };
  Section section = random_section(random, 2, 1);
  section.friction.coefficient = -0.1;
  refused(section, "coefficient of friction");
  section = random_section(random, 2, 1);
  section.friction.sliding_time_s = 0;
  refused(section, "sliding time");
  refused(random_section(random, 3, 1), "friction needs a single slit");
}
