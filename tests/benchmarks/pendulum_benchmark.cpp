// SPDX-License-Identifier: GPL-3.0-or-later
// Times the first 0.25 s of a pendulum run. README.md describes the comparison.
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <vector>

#include "geometry/foundation/in_parallel.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/benchmarks/timing.h"
#include "tests/support/test_models.h"

namespace {

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Vector3d;

constexpr int kDefaultRuns = 51;
const SolverOptions kSolver{.relative_tolerance = 1e-6, .absolute_tolerance = 1e-9};
const OutputOptions kOutput{.end_time_s = 0.25, .interval_s = 1e-3};

/// An arm that arrives at 7.01 m/s and is stopped by a pulse like that of a certification test.
PrescribedBody make_arm() {
  constexpr double g = 9.80665;
  const TimeTable pulse({0, 0.004, 0.010, 0.020, 0.030, 0.0365, 0.042},
                        {0, -24.15 * g, -24.15 * g, -19.45 * g, -14.95 * g, -13.85 * g, 0},
                        TimeTable::Outside::zero);
  return {Vector3d::UnitX(), 7.01, pulse};
}

Model flexible_neck() {
  ModelBuilder build = head_on_neck(make_arm(), hanging_pose(), Beam{}, 0.9, make_head());
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  return build.model;
}

/// The same neck as one rigid body on a spherical joint.
Model rigid_neck() {
  Model model = flexible_neck();
  const flexneck::fe_modal::ModalBody beam = std::get<DeformableBody>(model.bodies[1].kind).modes;
  RigidBody neck;
  neck.mass_kg = beam.invariants.mass;
  neck.center_m = beam.invariants.S1 / neck.mass_kg;
  neck.inertia_kg_m2 = beam.invariants.J0 -
                       neck.mass_kg * (neck.center_m.squaredNorm() * Eigen::Matrix3d::Identity() -
                                       neck.center_m * neck.center_m.transpose());
  model.bodies[1].kind = neck;
  for (Marker& marker : model.markers) {
    if (!marker.interface.empty()) marker.position_m = beam.interface(marker.interface).position_m;
    marker.interface.clear();
  }
  model.joints[0].kind = &kSphericalJoint;
  return model;
}

void report(const char* name, const Model& model, Formulation formulation, int runs) {
  SolverOptions solver = kSolver;
  solver.formulation = formulation;
  StepStatistics steps;
  const flexneck::benchmarks::Timing timing = flexneck::benchmarks::measure(
      runs, [&] { steps = simulate_from_equilibrium(model, solver, kOutput).statistics; });
  std::printf("%-24s %8.3f ms %8.3f ms %7d steps %3d rejected %7d right-hand sides\n", name,
              timing.median_ms, timing.fastest_ms, steps.accepted, steps.rejected,
              steps.evaluations);
}

/// Times 1000 simultaneous runs with pulses 0.1 % apart.
void report_batch(std::size_t count) {
  std::vector<Model> models(count, flexible_neck());
  for (std::size_t k = 0; k < count; ++k)
    std::get<PrescribedBody>(models[k].bodies[0].kind).initial_velocity_m_s +=
        1e-3 * static_cast<double>(k);
  const OutputOptions output{.end_time_s = 0.25, .interval_s = 0.0125};
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t cpu_start = std::clock();
  flexneck::in_parallel(
      count, 2, [&](std::size_t k) { simulate_from_equilibrium(models[k], kSolver, output); });
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  std::printf("batch of %zu on two threads %.3f s, CPU %.3f s\n", count, spent.count(),
              static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC);
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : kDefaultRuns;
  if (runs < 1) {
    std::fprintf(stderr, "usage: %s [RUNS]\n", argv[0]);
    return 2;
  }
  try {
    std::printf("pendulum, 0.25 s, relative tolerance 1e-6, %d runs: median, fastest\n", runs);
    report("4 modes, descriptor", flexible_neck(), Formulation::descriptor, runs);
    report("4 modes, recursive", flexible_neck(), Formulation::recursive, runs);
    report("rigid neck, descriptor", rigid_neck(), Formulation::descriptor, runs);
    report("rigid neck, recursive", rigid_neck(), Formulation::recursive, runs);
    report_batch(runs > 1 ? 1000 : 20);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
