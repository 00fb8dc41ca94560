// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "multibody/joints/joint_kinds.h"
#include "multibody/signals/response.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Vector3d;

namespace {

constexpr double kStill_Hz = 10;

/// A beam with one bending mode along x and one along y, of the same frequency.
Beam round_beam() {
  Beam beam;
  beam.fore_aft_modes = 1;
  beam.lateral_modes = 1;
  beam.fore_aft_Hz = beam.lateral_Hz = kStill_Hz;
  return beam;
}

/// A beam along z, clamped at its root to a hub with a prescribed spin about `axis`, struck at its
/// tip along `blow`.
History spinning_beam(const Vector3d& axis, double spin_Hz, const Vector3d& blow) {
  const Beam beam = round_beam();
  const Vector3d rate = 2 * std::numbers::pi * spin_Hz * axis;
  ModelBuilder build;
  PrescribedBody spinning;
  spinning.turn.axis = axis;
  spinning.turn.initial_rate_rad_s = rate.norm();
  const auto hub = build.body("hub", spinning);
  const auto arm =
      build.body("beam", deformable(make_beam_body(beam), 0), {}, Vector3d::Zero(), rate);
  const auto hub_marker = build.marker("hub", hub);
  build.joint("root", &kFixedJoint, hub_marker, build.interface_marker("root", arm, "base"));
  const auto tip = build.interface_marker("tip", arm, "top");
  const TimeTable force({0, 0.001, 0.002}, {0, 1, 0}, TimeTable::Outside::zero);
  build.force("strike", tip, blow, force);
  const SolverOptions solver = solver_of(1e-10, 1e-13);
  return simulate(build.model, solver, {.end_time_s = 2.0, .interval_s = 1e-3});
}

/// Mean frequency over all cycles of the record.
double mean_frequency_Hz(const History& history, const Eigen::VectorXd& signal) {
  const FreeOscillation found = free_oscillation(history.time_s, signal, 0, 0.01);
  const auto& crossings = found.crossings_s;
  REQUIRE(crossings.size() > 8);
  return 0.5 * static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
}

}  // namespace

TEST_CASE("Spin softens a linear body in its plane by the square of the spin, and not across it") {
  const double spin_Hz = GENERATE(0.0, 3.0, 6.0);
  const History history = spinning_beam(Vector3d::UnitY(), spin_Hz, {1, 1, 0});
  REQUIRE(history.modal[0].modes[0] == "fore-aft bending 1");
  // f^2 = f0^2 - spin^2: 10 and 6 leave 8. Crossings are interpolated over 1 ms of some tens of
  // cycles, which errs by less than 1e-6.
  CHECK(mean_frequency_Hz(history, history.modal[0].coordinates.row(0)) ==
        Approx(std::sqrt(kStill_Hz * kStill_Hz - spin_Hz * spin_Hz)).epsilon(2e-6));
  CHECK(mean_frequency_Hz(history, history.modal[0].coordinates.row(1)) ==
        Approx(kStill_Hz).epsilon(2e-6));
}

TEST_CASE("A round beam that spins about its own axis swings in a plane fixed in the world") {
  // In the spinning frame z = a_x + i a_y obeys z'' + 2 i W z' + (w^2 - W^2) z = 0, so that exp(i W
  // t) z is an oscillation of frequency w: the Coriolis and centrifugal terms cancel the effect of
  // the rotation.
  const double spin_Hz = GENERATE(2.0, 15.0);
  const History history = spinning_beam(Vector3d::UnitZ(), spin_Hz, {1, 0, 0});
  const Eigen::VectorXd along = history.marker("tip").position_m.row(0);
  const Eigen::VectorXd across = history.marker("tip").position_m.row(1);
  CHECK(mean_frequency_Hz(history, along) == Approx(kStill_Hz).epsilon(2e-6));
  CHECK(across.cwiseAbs().maxCoeff() < 1e-6 * along.cwiseAbs().maxCoeff());
}
