// SPDX-License-Identifier: GPL-3.0-or-later
// Balances and symmetries of whole runs, which check every term of the equations at once.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "multibody/history/energy_guard.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/formulations.h"
#include "tests/support/point_mass_body.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

SolverOptions solver_of(double tolerance, Formulation formulation) {
  return {.relative_tolerance = tolerance,
          .absolute_tolerance = 1e-3 * tolerance,
          .formulation = formulation};
}

Beam soft_beam() {
  Beam beam;
  beam.length_m = 0.5;
  beam.mass_kg = 0.8;
  beam.fore_aft_Hz = 9;
  beam.lateral_Hz = 13;
  beam.twist_Hz = 20;
  beam.twist_modes = 1;
  return beam;
}

/// Base – pin – arm – ball – flexible body – fixed – flexible beam – fixed – head, spinning, with
/// every kind of joint and deformable bodies on both sides. `world` rotates the whole model with
/// its gravity.
ModelBuilder mixed_chain(const PrescribedBody& base, double zeta, const Quaterniond& world) {
  const Beam beam = soft_beam();
  const auto lump = make_point_mass_body(3).body;
  const auto pose = [&](const Vector3d& position) { return Pose{world * position, world}; };
  const Vector3d spin(0.5, 1.0, 2.0);
  const Vector3d slide = world * (base.initial_velocity_m_s * base.direction);
  PrescribedBody turned_base = base;
  turned_base.direction = world * base.direction;
  ModelBuilder build;
  const auto ground = build.body("base", turned_base, pose(Vector3d::Zero()));
  const auto arm =
      build.body("arm", RigidBody{3, {0.1, 0, 0.3}, Vector3d(0.12, 0.11, 0.02).asDiagonal()},
                 pose(Vector3d::Zero()), slide);
  const Vector3d joint2(0.1, 0, 0.6);
  const Vector3d origin = joint2 - lump.interface("side").position_m;
  const Vector3d joint3 = origin + lump.interface("tip").position_m;
  const Vector3d joint4 = joint3 + Vector3d(0, 0, beam.length_m);
  // All bodies beyond the spherical joint spin about it; the arm starts at rest relative to the
  // base.
  const auto rate_of = [&](const Vector3d& point) -> Vector3d {
    return slide + world * spin.cross(point - joint2);
  };
  const auto middle =
      build.body("middle", deformable(lump, zeta), pose(origin), rate_of(origin), spin);
  const auto bar = build.body("bar", deformable(make_beam_body(beam), zeta), pose(joint3),
                              rate_of(joint3), spin);
  const auto head = build.body("head", make_head(), pose(joint4), rate_of(joint4), spin);
  build.joint("pivot", &kRevoluteJoint, build.marker("ground", ground), build.marker("eye", arm));
  build.joint("ball", &kSphericalJoint, build.marker("arm end", arm, joint2),
              build.interface_marker("lump side", middle, "side"));
  build.joint("weld", &kFixedJoint, build.interface_marker("lump tip", middle, "tip"),
              build.interface_marker("bar base", bar, "base"));
  build.joint("OC", &kFixedJoint, build.interface_marker("bar top", bar, "top"),
              build.marker("head joint", head));
  build.marker("head cg", head, make_head().center_m);
  build.model.gravity_m_s2 = world * Vector3d(1, 0.5, -kGravity);
  return build;
}

/// Adds springs, bushings, a torque and resistances of the joints.
void add_all_forces(Model& model) {
  const auto marker = [&](const char* name) { return model.marker_index(name); };
  Resistance stiff;
  stiff.positive.curve = LoadCurve::cubic(4, 1, 30);
  stiff.positive.stop = 0.2;
  stiff.positive.beyond_stop = LoadCurve::cubic(20, 40);
  stiff.positive.unloading_ratio = 0.5;
  stiff.negative.curve = LoadCurve::table({0, 0.2, 0.5}, {0, 2, 3});
  stiff.damping = 0.05;
  stiff.friction = 0.3;
  stiff.full_rate = 0.5;
  model.forces.add(Torque{"twist", marker("bar top"), Vector3d::UnitZ(),
                          TimeTable({0, 0.3, 0.6}, {0, 3, 0}, TimeTable::Outside::zero)});
  model.forces.add(MarkerSpring{"spring", marker("ground"), marker("head joint"), 0.9, stiff});
  model.forces.add(Bushing{"bushing", marker("eye"), marker("bar base"),
                           40 * Eigen::Matrix<double, 6, 6>::Identity(),
                           0.2 * Eigen::Matrix<double, 6, 6>::Identity()});
  model.forces.of<JointResistance>() = {
      {"hinge", model.joint_index("pivot"), JointCoordinate::angle, stiff},
      {"shoulder", model.joint_index("ball"), JointCoordinate::flexion, stiff}};
}

VectorXd balance(const EnergyHistory& energy) {
  return energy.kinetic_J + energy.gravitational_J + energy.strain_J + energy.dissipated_J -
         energy.work_J;
}

double largest_imbalance(const History& history) {
  const VectorXd sum = balance(history.energy);
  return (sum.array() - sum[0]).abs().maxCoeff();
}

}  // namespace

TEST_CASE("An undamped flexible chain keeps its energy, and better so the finer the tolerance") {
  const Formulation formulation = either_formulation();
  const ModelBuilder build = mixed_chain({}, 0, Quaterniond::Identity());
  const OutputOptions output{.end_time_s = 1, .interval_s = 0.05};
  const History coarse = simulate(build.model, solver_of(1e-6, formulation), output);
  const History fine = simulate(build.model, solver_of(1e-10, formulation), output);
  const double exchanged = coarse.energy.kinetic_J.maxCoeff() - coarse.energy.kinetic_J.minCoeff();
  CHECK(exchanged > 10);
  CHECK(fine.energy.strain_J.maxCoeff() > 1);
  CHECK(largest_imbalance(coarse) < 1e-4 * exchanged);
  CHECK(largest_imbalance(fine) < 1e-8 * exchanged);
  CHECK(largest_imbalance(coarse) > 100 * largest_imbalance(fine));
  CHECK(coarse.energy.dissipated_J.isZero(0));
  CHECK(fine.statistics.max_position_residual < 1e-11);
}

TEST_CASE("What damping takes and forces and a prescribed base give closes the balance of energy") {
  const Formulation formulation = either_formulation();
  const TimeTable pulse({0.1, 0.2, 0.4}, {0, -30, 0}, TimeTable::Outside::zero);
  const PrescribedBody base{Vector3d(1, 2, -1).normalized(), 4, pulse};
  ModelBuilder build = mixed_chain(base, 0.3, Quaterniond::Identity());
  add_all_forces(build.model);
  const TimeTable push({0.05, 0.3, 0.7}, {20, 60, 10}, TimeTable::Outside::zero);
  build.force("push", build.model.marker_index("lump tip"), {1, 1, 0}, push);
  build.force("pull", build.model.marker_index("head cg"), {0, 1, -2}, constant_table(15));
  const History history =
      simulate(build.model, solver_of(1e-10, formulation), {.end_time_s = 1, .interval_s = 0.05});
  const double work = history.energy.work_J.cwiseAbs().maxCoeff();
  CHECK(work > 10);
  CHECK(history.energy.dissipated_J[20] > 1);
  CHECK(largest_imbalance(history) < 1e-8 * work);
  for (Eigen::Index k = 1; k <= 20; ++k) {
    CHECK(history.energy.dissipated_J[k] > history.energy.dissipated_J[k - 1]);
  }
}

TEST_CASE("A model that is turned with its gravity by an odd angle moves the same") {
  const Formulation formulation = either_formulation();
  const Quaterniond world = Quaterniond(0.3, -0.8, 0.41, 0.77).normalized();
  const TimeTable pulse({0.0, 0.1, 0.2}, {0, -30, 0}, TimeTable::Outside::zero);
  const PrescribedBody base{Vector3d(1, 2, -1).normalized(), 4, pulse};
  const auto run = [&](const Quaterniond& turn) {
    ModelBuilder build = mixed_chain(base, 0.1, turn);
    build.force("push", build.model.marker_index("bar top"), turn * Vector3d(1, 0, 2),
                constant_table(20));
    return simulate(build.model, solver_of(1e-11, formulation),
                    {.end_time_s = 0.4, .interval_s = 0.1});
  };
  const History upright = run(Quaterniond::Identity());
  const History turned = run(world);
  const MarkerHistory& a = upright.marker("head cg");
  const MarkerHistory& b = turned.marker("head cg");
  // Step sizes differ a little, so the runs agree only within their accuracy.
  for (Eigen::Index k = 0; k < upright.time_s.size(); ++k) {
    CHECK((world * a.position_m.col(k) - b.position_m.col(k)).norm() < 1e-8);
    CHECK((world * a.velocity_m_s.col(k) - b.velocity_m_s.col(k)).norm() < 1e-7);
    CHECK((world * a.acceleration_m_s2.col(k) - b.acceleration_m_s2.col(k)).norm() < 1e-5);
    CHECK((world * rotation_at(a.rotation, k)).angularDistance(rotation_at(b.rotation, k)) < 1e-7);
    // Reactions are in a marker's own axes.
    for (const char* joint : {"weld", "OC"}) {
      CHECK((upright.joint(joint).force_N.col(k) - turned.joint(joint).force_N.col(k)).norm() <
            1e-4);
      CHECK((upright.joint(joint).moment_Nm.col(k) - turned.joint(joint).moment_Nm.col(k)).norm() <
            1e-4);
    }
  }
}

TEST_CASE("The same run gives the same numbers to the last bit") {
  const Formulation formulation = either_formulation();
  const auto run = [&] {
    return simulate(mixed_chain({}, 0.1, Quaterniond::Identity()).model,
                    solver_of(1e-6, formulation), {.end_time_s = 0.2, .interval_s = 0.05});
  };
  const History first = run();
  const History second = run();
  CHECK(first.marker("head cg").position_m == second.marker("head cg").position_m);
  CHECK(first.joint("OC").moment_Nm == second.joint("OC").moment_Nm);
  CHECK(first.statistics.evaluations == second.statistics.evaluations);
}

TEST_CASE("Both formulations follow the same path, of markers, modes, reactions and energies") {
  const TimeTable pulse({0.0, 0.1, 0.2}, {0, -30, 0}, TimeTable::Outside::zero);
  const PrescribedBody base{Vector3d(1, 2, -1).normalized(), 4, pulse};
  ModelBuilder build = mixed_chain(base, 0.1, Quaterniond::Identity());
  build.force("push", build.model.marker_index("bar top"), {1, 0, 2}, constant_table(20));
  const auto run = [&](Formulation formulation) {
    return simulate(build.model, solver_of(1e-11, formulation),
                    {.end_time_s = 0.4, .interval_s = 0.1});
  };
  const History a = run(Formulation::descriptor);
  const History b = run(Formulation::recursive);
  constexpr double kAgreement = 1e-9;
  for (std::size_t k = 0; k < a.markers.size(); ++k) {
    CAPTURE(a.markers[k].name);
    CHECK((a.markers[k].position_m - b.markers[k].position_m).cwiseAbs().maxCoeff() < kAgreement);
    CHECK((a.markers[k].rotation - b.markers[k].rotation).cwiseAbs().maxCoeff() < kAgreement);
    // Rates are larger by the bar's highest frequency, 2 pi 80 / s, accelerations by its square.
    CHECK((a.markers[k].velocity_m_s - b.markers[k].velocity_m_s).cwiseAbs().maxCoeff() <
          1e3 * kAgreement);
    CHECK((a.markers[k].acceleration_m_s2 - b.markers[k].acceleration_m_s2).cwiseAbs().maxCoeff() <
          1e5 * kAgreement);
  }
  for (std::size_t k = 0; k < a.joints.size(); ++k) {
    CHECK((a.joints[k].force_N - b.joints[k].force_N).cwiseAbs().maxCoeff() < 1e5 * kAgreement);
    CHECK((a.joints[k].moment_Nm - b.joints[k].moment_Nm).cwiseAbs().maxCoeff() < 1e5 * kAgreement);
  }
  for (std::size_t k = 0; k < a.modal.size(); ++k)
    CHECK((a.modal[k].coordinates - b.modal[k].coordinates).cwiseAbs().maxCoeff() < kAgreement);
  CHECK((balance(a.energy) - balance(b.energy)).cwiseAbs().maxCoeff() < 1e3 * kAgreement);
}

TEST_CASE("the balance of energy is told where it departs, and ends a run that stays wrong") {
  using Catch::Matchers::Contains;
  ModelBuilder build;
  build.body("block", make_head());
  const auto with_kinetic = [](double kinetic_J) {
    Energies energies;
    energies.kinetic_J = kinetic_J;
    return energies;
  };
  const auto guard_after = [&](double off_J, int steps) {
    EnergyGuard guard(build.model, {1e-6, 1e-9});
    guard.check(0, with_kinetic(100), 0, 0);
    for (int k = 1; k <= steps; ++k) guard.check(k, with_kinetic(100 + off_J), 0, 0);
    return guard;
  };
  CHECK(guard_after(0.099, 100).warnings().empty());
  REQUIRE(guard_after(-0.11, 100).warnings().size() == 1);
  CHECK_THAT(guard_after(-0.11, 100).warnings()[0], Contains("from 1 s on") && Contains("0.11 %"));
  CHECK_NOTHROW(guard_after(-9.9, 100));
  CHECK_NOTHROW(guard_after(-10.1, 19));
  CHECK_THROWS_WITH(guard_after(-10.1, 20), Contains("10.1 J") && Contains("are lost at 20 s"));
  CHECK_THROWS(guard_after(std::nan(""), 20));
  CHECK_FALSE(guard_after(std::nan(""), 1).warnings().empty());
  // An error of half the energy at the start of the motion is negligible against its later energy.
  EnergyGuard guard(build.model, {1e-6, 1e-9});
  guard.check(0, with_kinetic(0), 0, 0);
  guard.check(1, with_kinetic(1.5), 0, 1);
  for (int k = 2; k < 100; ++k) guard.check(k, with_kinetic(1000), 0, 1000);
  CHECK(guard.warnings().empty());
  // An output between two steps counts for the warnings.
  guard.see(100, with_kinetic(1002), 0, 1000);
  CHECK(guard.warnings().size() == 1);
}
