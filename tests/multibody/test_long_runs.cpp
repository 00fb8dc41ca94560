// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kLength_m = 0.5;

/// A flexible bar without damping on a revolute joint, released at 60 degrees from straight down.
Model flexible_pendulum() {
  Beam beam;
  beam.length_m = kLength_m;
  beam.mass_kg = 0.8;
  beam.gyration_m = 0.01;
  beam.fore_aft_Hz = 2;
  beam.lateral_Hz = 3;
  beam.fore_aft_modes = beam.lateral_modes = 1;
  ModelBuilder build;
  const Quaterniond turn(Eigen::AngleAxisd(std::numbers::pi * 2 / 3, Vector3d::UnitY()));
  const auto bar = build.body("bar", deformable(make_beam_body(beam), 0), {Vector3d::Zero(), turn});
  build.joint("pin", &kRevoluteJoint, build.marker("pivot", build.ground(), Vector3d::Zero(), turn),
              build.interface_marker("root", bar, "base"));
  build.interface_marker("tip", bar, "top");
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  return build.model;
}

/// Largest change of the total energy over 100 periods, relative to the exchanged energy.
double drift(Formulation formulation, double tolerance) {
  // The period of a rigid bar, T = 2 pi sqrt(2 L / 3 g), and 7 % more at 60 degrees.
  const double period_s = 1.07 * 2 * std::numbers::pi * std::sqrt(2 * kLength_m / (3 * kGravity));
  const SolverOptions solver{.relative_tolerance = tolerance,
                             .absolute_tolerance = 1e-3 * tolerance,
                             .formulation = formulation};
  const History history =
      simulate(flexible_pendulum(), solver, {.end_time_s = 100 * period_s, .interval_s = period_s});
  const EnergyHistory& energy = history.energy;
  const VectorXd total = energy.kinetic_J + energy.gravitational_J + energy.strain_J;
  CHECK(energy.strain_J.maxCoeff() > 2e-3 * energy.kinetic_J.maxCoeff());
  CHECK(energy.dissipated_J.isZero(0));
  CHECK(history.statistics.max_position_residual < 1e-12);
  return (total.array() - total[0]).abs().maxCoeff() / energy.kinetic_J.maxCoeff();
}

}  // namespace

TEST_CASE("The energy of an undamped flexible pendulum over 100 periods drifts as the tolerance") {
  // About 100 steps a period, each with an error of the tolerance: 1e4 times it at the most.
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    const double found = drift(Formulation::recursive, tolerance);
    INFO("tolerance " << tolerance << ", drift " << found);
    CHECK(found < 1e4 * tolerance);
    CHECK(found > 1e-2 * tolerance);
  }
  CHECK(drift(Formulation::descriptor, 1e-7) < 1e-3);
}
