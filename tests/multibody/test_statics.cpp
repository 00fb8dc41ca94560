// SPDX-License-Identifier: GPL-3.0-or-later
// Static equilibrium, the reading of a load cell in it, and small motions about it.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "multibody/analysis/linearisation.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/signals/load_cell.h"
#include "multibody/signals/response.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi;
/// SAE J211 channels of the joint "OC" between a fixed chest and a head on which a force acts.
VectorXd channels_of_manipulation(const Vector3d& at_m, const Vector3d& force_N) {
  ModelBuilder build;
  const auto chest = build.marker("chest", build.ground());
  const auto head = build.body("head", make_head());
  build.joint("OC", &kFixedJoint, chest, build.marker("head joint", head));
  build.force("hand", build.marker("grip", head, at_m), force_N, constant_table(force_N.norm()));
  const History history =
      simulate_from_equilibrium(build.model, {}, {.end_time_s = 1e-3, .interval_s = 1e-3});
  return sae_j211(history.joint("OC")).col(0);
}

}  // namespace

TEST_CASE("Load-cell channels have the signs of SAE J211's manipulations of the head") {
  // Axes: x forward, y left, z up. Points of the head and forces of a hand on them.
  const Vector3d forward(1, 0, 0);
  const Vector3d left(0, 1, 0);
  const Vector3d up(0, 0, 1);
  const Vector3d joint = Vector3d::Zero();
  constexpr double kPush_N = 100;
  constexpr double kArm_m = 0.1;
  const auto channels = [&](const Vector3d& at, const Vector3d& direction) {
    return channels_of_manipulation(at, kPush_N * direction);
  };
  CHECK(channels(joint, -forward)[0] == Approx(kPush_N));  // Fx: head rearward
  CHECK(channels(joint, left)[1] == Approx(kPush_N));      // Fy: head leftward
  CHECK(channels(joint, up)[2] == Approx(kPush_N));        // Fz: head upward
  const double moment = kPush_N * kArm_m;
  CHECK(channels(kArm_m * left, -up)[3] == Approx(moment));      // Mx: left ear down
  CHECK(channels(kArm_m * forward, -up)[4] == Approx(moment));   // My: chin to sternum
  CHECK(channels(kArm_m * forward, left)[5] == Approx(moment));  // Mz: chin to the left
  // A force through the joint has no moment, one at an arm only its own.
  CHECK(channels(joint, up).tail<3>().norm() < 1e-9);
  CHECK(channels(kArm_m * left, -up).tail<2>().norm() < 1e-9);
}

TEST_CASE("Hanging at rest, the head's joint carries the head and the base both, as tension") {
  const RigidBody head = make_head();
  const Beam beam;
  ModelBuilder build = head_on_neck({}, hanging_pose(), beam, 0.9, head);
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  const History history = simulate_from_equilibrium(build.model, tight_solver(),
                                                    {.end_time_s = 0.2, .interval_s = 0.1});
  const double head_weight = head.mass_kg * kGravity;
  const double weight = head_weight + beam.mass_kg * kGravity;
  const Vector3d rest = history.marker("head cg").position_m.col(0);
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    CHECK((history.marker("head cg").position_m.col(k) - rest).norm() < 1e-9);
    const VectorXd base = sae_j211(history.joint("neck base")).col(k);
    CHECK(base[2] == Approx(weight).epsilon(1e-9));
    CHECK(base.head<2>().norm() < 1e-6);
    // The load cell in the head's joint has rotated with the neck's top.
    const auto turn = rotation_at(history.marker("neck top").rotation, k);
    const Vector3d up = turn.conjugate() * Vector3d(0, 0, head_weight);
    CHECK((history.joint("OC").force_N.col(k) - up).norm() < 1e-7 * head_weight);
    // It holds the weight's moment about the joint point.
    const Vector3d arm =
        history.marker("head cg").position_m.col(k) - history.marker("neck top").position_m.col(k);
    const Vector3d expected = (turn.conjugate() * arm).cross(up);
    CHECK((history.joint("OC").moment_Nm.col(k) - expected).norm() < 1e-7 * head_weight);
  }
  // The head's centre of mass lies ahead of the neck's axis: its weight turns the chin away.
  CHECK(history.joint("OC").moment_Nm(1, 0) == Approx(head_weight * 0.014).epsilon(0.1));
}

TEST_CASE("One bending mode and a head make the oscillator of the closed form") {
  // M = 1 + psi' m psi + 2 psi' m z mu + mu' J mu; f = f1 / sqrt(M); zeta = zeta1 f / f1.
  Beam beam;
  beam.fore_aft_modes = 1;
  beam.lateral_modes = 0;
  const double zeta = GENERATE(0.05, 0.9);
  RigidBody head = make_head();
  head.center_m = {0, 0, 0.0508};
  head.inertia_kg_m2 = Vector3d(0.02, 0.024, 0.02).asDiagonal();
  const ModelBuilder build = head_on_neck({}, {}, beam, zeta, head);
  const auto top = make_beam_body(beam).interface("top");
  const double translation = top.translation(0, 0) + head.center_m[2] * top.rotation(1, 0);
  const double mass = 1 + head.mass_kg * translation * translation +
                      head.inertia_kg_m2(1, 1) * std::pow(top.rotation(1, 0), 2);
  const double frequency_Hz = beam.fore_aft_Hz / std::sqrt(mass);
  const double damping = zeta * frequency_Hz / beam.fore_aft_Hz;
  const std::vector<SystemMode> modes = system_modes(build.model);
  REQUIRE(modes.size() == 1);
  CHECK(modes[0].frequency_Hz == Approx(frequency_Hz).epsilon(1e-6));
  CHECK(modes[0].damping_ratio == Approx(damping).epsilon(1e-6));
  CHECK(modes[0].damped_frequency_Hz ==
        Approx(frequency_Hz * std::sqrt(1 - damping * damping)).epsilon(1e-6));
}

TEST_CASE("Small motions of the hanging head have the frequency and damping of the linear system") {
  Beam beam;
  beam.fore_aft_modes = 1;
  beam.lateral_modes = 0;
  ModelBuilder build = head_on_neck({}, hanging_pose(), beam, 0.6, make_head());
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  const std::vector<SystemMode> modes = system_modes(build.model);
  REQUIRE(modes.size() == 1);
  const TimeTable tap({0.0, 0.005, 0.01}, {0, 0.1, 0}, TimeTable::Outside::zero);
  build.force("tap", build.model.marker_index("head cg"), {1, 0, 0}, tap);
  const History history =
      simulate_from_equilibrium(build.model, tight_solver(), {.end_time_s = 1, .interval_s = 5e-4});
  const VectorXd signal = history.modal[0].coordinates.row(0).transpose();
  const FreeOscillation found = free_oscillation(history.time_s, signal, signal[0], 0.011);
  REQUIRE(cycle_damping_ratio(found));
  // Interpolation between samples allows 1e-4; terms of second order are below 1e-5.
  CHECK(*cycle_frequency_Hz(found) == Approx(modes[0].damped_frequency_Hz).epsilon(1e-4));
  CHECK(*cycle_damping_ratio(found) == Approx(modes[0].damping_ratio).epsilon(1e-3));
  CHECK(modes[0].frequency_Hz * std::sqrt(1 - std::pow(modes[0].damping_ratio, 2)) ==
        Approx(modes[0].damped_frequency_Hz).epsilon(1e-9));
}

TEST_CASE("A rigid pendulum's small motions have the frequency of its length") {
  ModelBuilder build;
  const auto ground = build.ground();
  const auto bob =
      build.body("bob", RigidBody{2, {0, 0, -0.5}, Vector3d(0.6, 0.5, 0.3).asDiagonal()},
                 {Vector3d::Zero(), Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vector3d::UnitY()))});
  build.joint("pin", &kRevoluteJoint, build.marker("pivot", ground), build.marker("eye", bob));
  build.model.gravity_m_s2 = {0, 0, -kGravity};
  const std::vector<SystemMode> modes = system_modes(build.model);
  REQUIRE(modes.size() == 1);
  CHECK(modes[0].frequency_Hz == Approx(std::sqrt(kGravity) / (2 * kPi)).epsilon(1e-6));
  CHECK(std::abs(modes[0].damping_ratio) < 1e-6);
}
