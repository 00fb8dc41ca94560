// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "multibody/forces/cable.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/numerics/rotation.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/point_mass_body.h"
#include "tests/support/test_models.h"

using Eigen::Vector3d;
using namespace flexneck::multibody;
using namespace flexneck::testing;

TEST_CASE("a cable's load is the gradient of its energy, taut, in its play, yielding and slack") {
  RandomNumbers random(81);
  constexpr double kStep = 1e-6;
  for (const double longer : {0.03, 0.005, -0.02, -0.2}) {
    MarkerKinematics i, j;
    i.R = random.rotation().toRotationMatrix();
    j.p = i.R * Vector3d(0.05, -0.02, 0.4);
    j.R = i.R * rotation_exp(Vector3d(0.7, -0.4, 0.3));
    // The path is an arc about the part's axis.
    const double half = Vector3d(0.7, -0.4, 0).norm() / 2;
    const double path = j.p.norm() * half / std::sin(half);
    const Cable cable{"cable", 0, 1, Vector3d::UnitZ(), path - longer, 50, 600, 0.01};
    const auto acted = [&](const MarkerKinematics& at) {
      ForceLoad load;
      ForceEnergies sums;
      cable.act({i, at, {}, {}, 0}, load, sums);
      return std::pair(sums.stored_J, load);
    };
    const ForceLoad load = acted(j).second;
    CAPTURE(longer);
    const double pull =
        longer > 0.01 ? 600 * (longer - 0.01) : (longer > 0 ? 0 : std::max(600 * longer, -50.0));
    CHECK(load.force_N.norm() * std::sin(half) / half == Approx(std::abs(pull)).margin(1e-12));
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto slope = [&](double moved, double turned) {
        const auto energy = [&](double sign) {
          MarkerKinematics at = j;
          at.p += sign * moved * Vector3d::Unit(axis);
          at.R = rotation_exp(sign * turned * Vector3d::Unit(axis)) * at.R;
          return acted(at).first;
        };
        return (energy(1) - energy(-1)) / (2 * kStep);
      };
      CHECK(load.force_N[axis] == Approx(-slope(kStep, 0)).margin(1e-6));
      CHECK(load.moment_Nm[axis] == Approx(-slope(0, kStep)).margin(1e-6));
    }
  }
}

TEST_CASE("a block on a cable swings half periods on its stiffness and glides through its play") {
  constexpr double kMass = 2;
  constexpr double kStiffness = 800;
  constexpr double kPlay = 0.05;
  constexpr double kSpeed = 0.5;
  ModelBuilder build;
  const auto ground = build.marker("ground", build.ground());
  const auto block = build.marker(
      "block", build.body("block", RigidBody{kMass, Vector3d::Zero(), Eigen::Matrix3d::Identity()},
                          {{0, 0, 1}}, {0, 0, kSpeed}));
  build.joint("slide", &kPrismaticJoint, ground, block, Vector3d::UnitZ());
  build.model.forces.add(
      Cable{"cable", ground, block, Vector3d::UnitZ(), 1, 1e4, kStiffness, kPlay});
  const double half = std::numbers::pi * std::sqrt(kMass / kStiffness);
  const double period = 2 * half + 2 * kPlay / kSpeed;
  const History history = simulate(build.model, solver_of(1e-10, 1e-12),
                                   {.end_time_s = 3 * period, .interval_s = period});
  for (Eigen::Index k = 0; k <= 3; ++k) {
    CHECK(history.marker("block").position_m(2, k) == Approx(1).epsilon(1e-8));
    CHECK(history.marker("block").velocity_m_s(2, k) == Approx(kSpeed).epsilon(1e-8));
  }
}
