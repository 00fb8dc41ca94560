// SPDX-License-Identifier: GPL-3.0-or-later
// Times chains of bodies. README.md describes the comparison.
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "multibody/equations/equations.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/benchmarks/chain_models.h"
#include "tests/benchmarks/simbody_chain.h"
#include "tests/benchmarks/timing.h"
#include "tests/support/test_models.h"

namespace {

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using flexneck::benchmarks::measure;
using flexneck::benchmarks::rigid_chain;
using flexneck::benchmarks::rod;
using flexneck::benchmarks::Timing;

/// Formulation of the equations of motion and method of integration.
struct Method {
  const char* name;
  Formulation formulation;
  Integrator integrator;
};
constexpr Method kRecursive{"recursive", Formulation::recursive, Integrator::dormand_prince};
constexpr Method kDescriptor{"descriptor", Formulation::descriptor, Integrator::dormand_prince};
constexpr Method kRecursiveAlpha{"recursive, alpha", Formulation::recursive,
                                 Integrator::generalised_alpha};
constexpr Method kDescriptorAlpha{"descriptor, alpha", Formulation::descriptor,
                                  Integrator::generalised_alpha};

/// Chain of links of 0.1 m on revolute joints with axes along x and y in turn, hanging straight.
Model hanging_chain(int links) {
  ModelBuilder build;
  constexpr double kLength_m = 0.1;
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  std::size_t above = build.marker("ground", build.ground());
  for (int k = 0; k < links; ++k) {
    const std::string name = std::to_string(k);
    const auto link = build.body("link " + name, rod(0.2, kLength_m, {2e-4, 2e-4, 2e-5}),
                                 {{0, 0, -kLength_m * k}});
    build.joint("pin " + name, &kRevoluteJoint, above, build.marker("top " + name, link),
                k % 2 == 0 ? Vector3d::UnitX() : Vector3d::UnitY());
    above = build.marker("bottom " + name, link, {0, 0, -kLength_m});
  }
  return build.model;
}

/// One evaluation of the equations of motion.
double evaluation_us(const Model& model, Formulation formulation, int repetitions) {
  SolverOptions solver;
  const auto equations = formulation == Formulation::recursive
                             ? recursive_equations(model, solver)
                             : descriptor_equations(model, solver);
  const Eigen::VectorXd state = equations->given_state();
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(state.size());
  const Timing timing = measure(5, [&] {
    for (int k = 0; k < repetitions; ++k) equations->derivative(0, state, rate);
  });
  return 1e3 * timing.median_ms / repetitions;
}

void report_growth() {
  std::printf("one evaluation of a hanging chain, in us and in us a body\n");
  std::printf("%8s %24s %24s\n", "bodies", "recursive", "descriptor");
  for (const int links : {1, 2, 5, 10, 20, 50, 100, 200, 500, 1000}) {
    const Model model = hanging_chain(links);
    const int repetitions = 20000 / links + 1;
    const double recursive = evaluation_us(model, Formulation::recursive, repetitions);
    const double descriptor = evaluation_us(model, Formulation::descriptor, repetitions);
    std::printf("%8d %12.2f %11.3f %12.2f %11.3f\n", links, recursive, recursive / links,
                descriptor, descriptor / links);
  }
}

/// Chain ground - pin - arm - fixed - flexible bar - fixed - head; the ground is jerked for 0.05 s.
/// The bar is Euler and Bernoulli's with its bending and torsion modes below 2 kHz; the half sine
/// is a table of 20 segments.
Model flexible_chain() {
  ModelBuilder build;
  constexpr double kArm_m = 1.5;
  Beam bar;
  bar.length_m = 0.5;
  bar.mass_kg = 0.2;
  bar.gyration_m = 0.02 / std::sqrt(12.0);
  bar.fore_aft_Hz = bar.lateral_Hz = 40.86;
  bar.fore_aft_modes = bar.lateral_modes = 4;
  bar.twist_Hz = 900;
  bar.twist_modes = 1;
  std::vector<double> times_s;
  std::vector<double> values;
  for (int k = 0; k <= 20; ++k) {
    times_s.push_back(0.05 * k / 20);
    values.push_back(-50 * std::sin(std::numbers::pi * k / 20));
  }
  const PrescribedBody ground{Vector3d::UnitX(), 0,
                              TimeTable(times_s, values, TimeTable::Outside::zero)};
  // The beam's z axis is along the bar, away from the arm.
  const Quaterniond down(0, 1, 0, 0);
  const double moment = 30 * kArm_m * kArm_m / 12;
  const auto base = build.body("ground", ground);
  const auto arm = build.body("arm", rod(30, kArm_m, {moment, moment, 0.1}));
  const auto flexible =
      build.body("bar", deformable(make_beam_body(bar), 0), {{0, 0, -kArm_m}, down});
  const auto head =
      build.body("head", rod(1, 0, {2e-3, 2e-3, 2e-3}), {{0, 0, -kArm_m - bar.length_m}, down});
  build.joint("pivot", &kRevoluteJoint, build.marker("ground", base), build.marker("eye", arm));
  build.joint("root", &kFixedJoint, build.marker("arm end", arm, {0, 0, -kArm_m}, down),
              build.interface_marker("bar base", flexible, "base"));
  build.joint("tip", &kFixedJoint, build.interface_marker("bar top", flexible, "top"),
              build.marker("head cg", head));
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  return build.model;
}

/// Times runs of 1 s and finds the error of the head's centre at the end against a run at 1e-12.
void report_run(const char* name, const Model& model, std::initializer_list<Method> methods,
                std::initializer_list<double> tolerances, int runs) {
  const OutputOptions output{.end_time_s = 1, .interval_s = 0.01};
  const auto run = [&](double tolerance, const Method& method) {
    const SolverOptions solver{.relative_tolerance = tolerance,
                               .absolute_tolerance = 1e-3 * tolerance,
                               .formulation = method.formulation,
                               .integrator = method.integrator};
    return simulate(model, solver, output);
  };
  const auto path = [](const History& history) { return history.marker("head cg").position_m; };
  const Eigen::Matrix3Xd exact = path(run(1e-12, kRecursive));
  const double peak = (exact.colwise() - exact.col(0)).colwise().norm().maxCoeff();
  std::printf("%s, 1 s: CPU time, error of the head at 1 s in m and of its largest displacement\n",
              name);
  std::printf("the head's centre ends at %.9f %.9f %.9f m\n", exact(0, exact.cols() - 1),
              exact(1, exact.cols() - 1), exact(2, exact.cols() - 1));
  for (const Method& method : methods)
    for (const double tolerance : tolerances) {
      History history;
      const Timing timing = measure(runs, [&] { history = run(tolerance, method); });
      const double error = (path(history).rightCols<1>() - exact.rightCols<1>()).norm();
      std::printf("%-18s %6.0e %9.3f ms %10.2e %10.2e %6d steps %6d evaluations; %s\n", method.name,
                  tolerance, timing.median_ms, error, error / peak, history.statistics.accepted,
                  history.statistics.evaluations, history.statistics.limits.front().what.c_str());
    }
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 11;
  if (runs < 1) {
    std::fprintf(stderr, "usage: %s [RUNS]\n", argv[0]);
    return 2;
  }
  report_growth();
  report_run("rigid chain", rigid_chain(), {kRecursive, kDescriptor}, {1e-5, 1e-6, 1e-7}, runs);
  flexneck::benchmarks::report_simbody_chain(runs);
  report_run("flexible chain", flexible_chain(),
             {kRecursive, kDescriptor, kRecursiveAlpha, kDescriptorAlpha}, {1e-4, 1e-5, 1e-6},
             runs);
  return 0;
}
