// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include <catch2/catch.hpp>

#include "multibody/forces/bushing.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace flexneck::multibody;
using namespace flexneck::testing;

namespace {

/// A body that spins about z, starting where its bushing is unloaded.
Model spinning(double rate_rad_s, double stiffness_Nm) {
  Model model;
  model.bodies = {{"ground", PrescribedBody(), {}},
                  {"wheel", RigidBody{1, Vector3d::Zero(), Matrix3d::Identity()}, {}}};
  model.bodies[1].initial_angular_velocity_rad_s = {0, 0, rate_rad_s};
  model.markers = {{"ground.at", 0, ""}, {"wheel.at", 1, ""}};
  Bushing bushing;
  bushing.name = "rubber";
  bushing.marker_i = 0;
  bushing.marker_j = 1;
  bushing.stiffness.diagonal().setConstant(stiffness_Nm);
  model.forces.add(std::move(bushing));
  model.gravity_m_s2.setZero();
  return model;
}

}  // namespace

TEST_CASE("a bushing that is turned by more than 3 rad ends the run there") {
  const SolverOptions solver = solver_of(1e-9, 1e-12);
  const double rate = GENERATE(2.0, -2.0);
  // 1 N m/rad on 1 kg m^2: the rotation is rate sin(t), 2 rad at most.
  CHECK_NOTHROW(simulate(spinning(rate, 1), solver, {.end_time_s = 7, .interval_s = 0.01}));
  try {
    // 3.5 sin(t) rad without the limit of half a turn: 3 rad at 1.03 s.
    simulate(spinning(1.75 * rate, 1), solver, {.end_time_s = 7, .interval_s = 0.01});
    FAIL("expected the run to end");
  } catch (const IncompleteRun& run) {
    CHECK_THAT(run.what(),
               Catch::Matchers::Contains("bushing 'rubber'") && Catch::Matchers::Contains("3 rad"));
    const Eigen::Index outputs = run.history.time_s.size();
    CHECK(run.history.time_s[outputs - 1] == Approx(std::asin(3 / 3.5)).margin(0.011));
  }
}
