// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "multibody/analysis/linearisation.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/numerics/rotation.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/test_models.h"

using Catch::Matchers::Contains;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace flexneck::multibody;
using namespace flexneck::testing;

namespace {

/// A body on a soft mount, made by a bushing or by the equivalent function, on a rotating sled.
struct Mounted {
  ModelBuilder build;
  std::size_t below = 0, above = 0;

  /// @param on_axle  the block can only rotate about and slide along the mount's z axis
  explicit Mounted(double sled_rate_rad_s, bool on_axle = false) {
    build.model.gravity_m_s2 = {1, -2, -9.81};
    PrescribedBody sled;
    sled.turn.axis = Vector3d(2, -1, 2) / 3;
    sled.turn.initial_rate_rad_s = sled_rate_rad_s;
    const Eigen::Quaterniond turned = quaternion_exp({0.3, -0.2, 0.4});
    const RigidBody block{2, {0.02, 0.01, -0.03}, Vector3d(0.02, 0.03, 0.04).asDiagonal()};
    const auto base = build.body("sled", sled, {Vector3d(0.1, 0.2, 0), turned});
    const auto body = build.body("block", block,
                                 {Vector3d(0.1, 0.2, 0) + turned * (kBelow_m - kAbove_m), turned});
    below = build.marker("below", base, kBelow_m, quaternion_exp({0, 0.5, 0.1}));
    above = build.marker("above", body, kAbove_m, quaternion_exp({0, 0.5, 0.1}));
    if (on_axle) build.joint("axle", &kCylindricalJoint, below, above, Vector3d::UnitZ());
  }

 private:
  const Vector3d kBelow_m{0.05, 0, 0.1};
  const Vector3d kAbove_m{0, 0.01, 0};
};

Bushing mount(const Mounted& mounted) {
  Bushing bushing{"mount", mounted.below, mounted.above};
  bushing.stiffness.diagonal() << 900, 1200, 1500, 20, 25, 30;
  bushing.damping.diagonal() << 5, 6, 7, 0.1, 0.2, 0.3;
  return bushing;
}

/// The bushing's load, written independently: e^T K e / 2 has the moment J_l^-T K theta.
FunctionForce mount_by_function(const Mounted& mounted) {
  const Bushing bushing = mount(mounted);
  FunctionForce force{"mount", mounted.below, mounted.above, {}, true};
  force.load = [K = bushing.stiffness, C = bushing.damping](double, const RelativeMotion& motion) {
    const Vector3d theta = rotation_log(motion.rotation);
    FunctionLoad load;
    load.force_N = -K.topLeftCorner<3, 3>() * motion.position_m -
                   C.topLeftCorner<3, 3>() * motion.velocity_m_s;
    load.moment_Nm =
        -left_jacobian(theta).transpose().inverse() * K.bottomRightCorner<3, 3>() * theta -
        C.bottomRightCorner<3, 3>() * motion.angular_velocity_rad_s;
    return load;
  };
  return force;
}

}  // namespace

TEST_CASE("a bushing that is written as a function moves and loads the same") {
  Mounted by_element(1.5);
  Mounted by_function(1.5);
  by_element.build.model.forces.add(mount(by_element));
  by_function.build.model.forces.add(mount_by_function(by_function));
  const SolverOptions solver = solver_of(1e-10, 1e-13);
  const OutputOptions output{.end_time_s = 0.5, .interval_s = 0.05};
  const History element = simulate(by_element.build.model, solver, output);
  const History function = simulate(by_function.build.model, solver, output);
  const MarkerHistory& a = element.marker("above");
  const MarkerHistory& b = function.marker("above");
  CHECK((a.position_m - b.position_m).norm() < 1e-9);
  CHECK((a.acceleration_m_s2 - b.acceleration_m_s2).norm() < 1e-6 * a.acceleration_m_s2.norm());
  CHECK((a.angular_acceleration_rad_s2 - b.angular_acceleration_rad_s2).norm() <
        1e-6 * a.angular_acceleration_rad_s2.norm());
  // Energies: the function has given as work what the element stores and dissipates.
  const EnergyHistory& books = function.energy;
  CHECK(books.dissipated_J.norm() == 0);
  const Eigen::VectorXd total = books.kinetic_J + books.gravitational_J - books.work_J;
  CHECK((total.array() - total[0]).abs().maxCoeff() < 1e-7 * books.kinetic_J.maxCoeff());
  const Eigen::VectorXd kept = (element.energy.strain_J + element.energy.dissipated_J -
                                element.energy.work_J + books.work_J);
  CHECK((kept.array() - kept[0]).abs().maxCoeff() < 1e-7 * books.kinetic_J.maxCoeff());
}

TEST_CASE("equilibrium and small motions of a function are those of the bushing") {
  Mounted by_element(0, true);
  Mounted by_function(0, true);
  by_element.build.model.forces.add(mount(by_element));
  by_function.build.model.forces.add(mount_by_function(by_function));
  const std::vector<SystemMode> element = system_modes(by_element.build.model);
  const std::vector<SystemMode> function = system_modes(by_function.build.model);
  REQUIRE(element.size() == 2);
  REQUIRE(function.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(function[k].frequency_Hz == Approx(element[k].frequency_Hz).epsilon(1e-6));
    CHECK(function[k].damping_ratio == Approx(element[k].damping_ratio).epsilon(1e-6));
  }
  const OutputOptions output{.end_time_s = 0.1, .interval_s = 0.1};
  const SolverOptions solver = solver_of(1e-9, 1e-12);
  const Vector3d rest = simulate_from_equilibrium(by_element.build.model, solver, output)
                            .marker("above")
                            .position_m.col(0);
  CHECK((simulate_from_equilibrium(by_function.build.model, solver, output)
             .marker("above")
             .position_m.col(0) -
         rest)
            .norm() < 1e-9);
}

TEST_CASE("a function is asked at the time of the run, and implicit steps take it, too") {
  ModelBuilder build;
  const auto rail = build.marker("rail", build.ground());
  const auto block = build.marker(
      "block", build.body("block", RigidBody{2, Vector3d::Zero(), Matrix3d::Identity()}));
  build.model.forces.add(
      FunctionForce{"push", rail, block, [](double time_s, const RelativeMotion& motion) {
                      return FunctionLoad{Vector3d(6 * time_s, -200 * motion.position_m.y(), 0),
                                          Vector3d::Zero()};
                    }});
  SolverOptions solver = solver_of(1e-8, 1e-11);
  solver.integrator = GENERATE(Integrator::dormand_prince, Integrator::generalised_alpha);
  const double tolerance = solver.integrator == Integrator::dormand_prince ? 1e-8 : 1e-4;
  const History history = simulate(build.model, solver, {.end_time_s = 1, .interval_s = 1});
  // x'' = 3 t.
  CHECK(history.marker("block").position_m(0, 1) == Approx(0.5).epsilon(tolerance));
}

TEST_CASE("a load's short pulse in time or along the way is not stepped over") {
  constexpr double kMass_kg = 2;
  constexpr double kSpeed_m_s = 3;
  ModelBuilder build;
  const auto rail = build.marker("rail", build.ground());
  const auto body = build.body("block", RigidBody{kMass_kg, Vector3d::Zero(), Matrix3d::Identity()},
                               {}, {kSpeed_m_s, 0, 0});
  const auto block = build.marker("block", body);
  build.joint("slide", &kPrismaticJoint, rail, block, Vector3d::UnitX());
  SolverOptions solver;
  solver.formulation = either_formulation();
  solver.integrator = GENERATE(Integrator::dormand_prince, Integrator::generalised_alpha);
  const double tolerance = solver.integrator == Integrator::dormand_prince ? 1e-4 : 1e-2;
  const auto push = [&](const FunctionForce::Function& along_x) {
    build.model.forces.add(FunctionForce{"hit", rail, block, along_x});
    const History history = simulate(build.model, solver, {.end_time_s = 3, .interval_s = 3});
    return history.marker("block").velocity_m_s(0, 1);
  };
  const auto of_x = [](double x) { return FunctionLoad{{x, 0, 0}, Vector3d::Zero()}; };
  SECTION("a bell over 2 ms") {
    const double v = push([&](double t, const RelativeMotion&) {
      return of_x(1000 * std::exp(-std::pow((t - 1.5) / 0.002, 2)));
    });
    CHECK(kMass_kg * (v - kSpeed_m_s) ==
          Approx(2 * std::sqrt(std::numbers::pi)).epsilon(tolerance));
  }
  SECTION("a box of 2 ms, with drag before and behind") {
    const double v = push([&](double t, const RelativeMotion& motion) {
      return of_x((t > 1.5 && t < 1.502 ? 1000 : 0) - 0.4 * motion.velocity_m_s.x());
    });
    const auto decay = [&](double time_s) { return std::exp(-0.2 * time_s); };
    CHECK(v == Approx(kSpeed_m_s * decay(3) + 2500 * (1 - decay(0.002)) * decay(1.498))
                   .epsilon(tolerance));
  }
  SECTION("a bump 5 mm wide that the block runs through: its work") {
    const double v = push([&](double, const RelativeMotion& motion) {
      const double x = motion.position_m.x() - 4;
      return of_x(std::abs(x) < 0.0025 ? 1000 * std::cos(std::numbers::pi * x / 0.005) : 0);
    });
    const double work_J = 1000 * 2 * 0.005 / std::numbers::pi;
    CHECK(v ==
          Approx(std::sqrt(kSpeed_m_s * kSpeed_m_s + 2 * work_J / kMass_kg)).epsilon(tolerance));
  }
}

TEST_CASE("what a function must not do is refused") {
  Mounted mounted(0);
  FunctionForce force = mount_by_function(mounted);
  SECTION("nothing") {
    force.load = nullptr;
    mounted.build.model.forces.add(force);
    CHECK_THROWS_WITH(check(mounted.build.model),
                      Contains("function_force 'mount'") && Contains("found none"));
  }
  SECTION("one body") {
    force.marker_i = force.marker_j;
    mounted.build.model.forces.add(force);
    CHECK_THROWS_WITH(check(mounted.build.model), Contains("two bodies"));
  }
  SECTION("no number: what was computed is kept") {
    force.load = [](double time_s, const RelativeMotion&) {
      const double value = time_s < 0.05 ? 0 : std::numeric_limits<double>::quiet_NaN();
      return FunctionLoad{Vector3d::Constant(value), Vector3d::Zero()};
    };
    mounted.build.model.forces.add(force);
    try {
      simulate(mounted.build.model, {}, {.end_time_s = 0.2, .interval_s = 0.01});
      FAIL("expected the run to end");
    } catch (const IncompleteRun& run) {
      CHECK_THAT(run.what(),
                 Contains("function_force 'mount'") && Contains("a load that is not finite"));
      CHECK(run.history.time_s.size() > 1);
    }
  }
}

TEST_CASE("a checkpoint ends a run by what it throws") {
  Mounted mounted(0, true);
  mounted.build.model.forces.add(mount(mounted));
  struct Enough {};
  int calls = 0;
  SolverOptions solver;
  solver.checkpoint = [&] {
    if (++calls == 3) throw Enough();
  };
  CHECK_THROWS_AS(simulate(mounted.build.model, solver, {.end_time_s = 1, .interval_s = 0.1}),
                  Enough);
  calls = 0;
  CHECK_THROWS_AS(settle(mounted.build.model, solver, {.end_time_s = 1, .interval_s = 0.1}),
                  Enough);
}
