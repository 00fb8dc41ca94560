// SPDX-License-Identifier: GPL-3.0-or-later
// Andrews' squeezing mechanism, as in Hairer and Wanner II and the test set for initial value
// problems: seven planar bodies in three loops. In space its ten revolute joints have 50 rows for
// 42 coordinates with one degree of freedom, so nine rows are redundant.
#include <cmath>
#include <numbers>
#include <string>

#include <catch2/catch.hpp>

#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

constexpr double d = 0.028, da = 0.0115, e = 0.02, ea = 0.01421, rr = 0.007, ra = 0.00092;
constexpr double ss = 0.035, sa = 0.01874, sb = 0.01043, sc = 0.018, sd = 0.02, ta = 0.02308;
constexpr double tb = 0.00916, u = 0.04, ua = 0.01228, ub = 0.00449, zf = 0.02, zt = 0.04;
constexpr double fa = 0.01421, kTorque_Nm = 0.033, kStiffness_N_m = 4530, kFreeLength_m = 0.07785;
const Vector3d A(-0.06934, -0.00227, 0);
const Vector3d B(-0.03635, 0.03273, 0);
const Vector3d C(0.014, 0.072, 0);

/// Angles of the bodies K1 … K7 in the plane, from the coordinates beta, Theta, gamma, phi, delta,
/// Omega, epsilon.
using Angles = std::array<double, 7>;
Angles body_angles(const Angles& q) {
  return {q[0], q[0] + q[1], q[2], q[3] + q[4], q[4], q[5] + q[6], q[6]};
}

constexpr Angles kStart = {-0.0617138900142764496, 0,
                           0.455279819163070380,   0.222668390165885885,
                           0.487364979543842550,   -0.222668390165885885,
                           1.23054744454982119};
constexpr Angles kPublished = {15.81077119629904,   -15.75637105984298, 0.04082224013073101,
                               -0.5347301163226948, 0.5244099658805304, 0.5347301163226948,
                               1.048080741042263};

/// The mechanism. Origins: K1 at O, K2 at its joint on K1, K3 at B, K4 at its joint on K5, K5 and
/// K7 at A, K6 at its joint on K7.
Model mechanism() {
  const Angles angles = body_angles(kStart);
  const auto turn = [&](int k) {
    return Quaterniond(
        Eigen::AngleAxisd(angles[static_cast<std::size_t>(k - 1)], Vector3d::UnitZ()));
  };
  ModelBuilder build;
  const auto ground = build.ground();
  const auto body = [&](int k, double mass_kg, double inertia_kg_m2, const Vector3d& center,
                        const Vector3d& origin) {
    return build.body("K" + std::to_string(k),
                      RigidBody{mass_kg, center, inertia_kg_m2 * Eigen::Matrix3d::Identity()},
                      {origin, turn(k)});
  };
  const Vector3d F = turn(1) * Vector3d(rr, 0, 0);
  const Vector3d P4 = A + turn(5) * Vector3d(zt, 0, 0);
  const Vector3d P6 = A + turn(7) * Vector3d(0, -u, 0);
  const auto K1 = body(1, 0.04325, 2.194e-6, {ra, 0, 0}, Vector3d::Zero());
  const auto K2 = body(2, 0.00365, 4.410e-7, {-da, 0, 0}, F);
  const auto K3 = body(3, 0.02373, 5.255e-6, {sb, -sa, 0}, B);
  const auto K4 = body(4, 0.00706, 5.667e-7, {0, -(e - ea), 0}, P4);
  const auto K5 = body(5, 0.07050, 1.169e-5, {ta, tb, 0}, A);
  const auto K6 = body(6, 0.00706, 5.667e-7, {zf - fa, 0, 0}, P6);
  const auto K7 = body(7, 0.05498, 1.912e-5, {-ub, -ua, 0}, A);
  const auto pin = [&](const std::string& name, std::size_t body_i, const Vector3d& on_i,
                       std::size_t body_j, const Vector3d& on_j) {
    build.joint(name, &kRevoluteJoint, build.marker(name + " i", body_i, on_i),
                build.marker(name + " j", body_j, on_j), Vector3d::UnitZ());
  };
  pin("O", ground, Vector3d::Zero(), K1, Vector3d::Zero());
  pin("F", K1, {rr, 0, 0}, K2, Vector3d::Zero());
  pin("B", ground, B, K3, Vector3d::Zero());
  pin("A5", ground, A, K5, Vector3d::Zero());
  pin("A7", ground, A, K7, Vector3d::Zero());
  pin("P4", K5, {zt, 0, 0}, K4, Vector3d::Zero());
  pin("P6", K7, {0, -u, 0}, K6, Vector3d::Zero());
  pin("E3", K2, {-d, 0, 0}, K3, {0, -ss, 0});
  pin("E4", K2, {-d, 0, 0}, K4, {0, -e, 0});
  pin("E6", K2, {-d, 0, 0}, K6, {zf, 0, 0});
  for (int k = 1; k <= 7; ++k)
    build.marker("frame " + std::to_string(k), build.model.body_index("K" + std::to_string(k)));
  build.model.forces.add(Torque{"drive", build.model.marker_index("frame 1"), Vector3d::UnitZ(),
                                constant_table(kTorque_Nm)});
  MarkerSpring spring{"spring",
                      build.marker("C", ground, C),
                      build.marker("D", K3, {sd, -sc, 0}),
                      kFreeLength_m,
                      {}};
  spring.resistance.positive.curve = LoadCurve::cubic(kStiffness_N_m);
  spring.resistance.negative.curve = LoadCurve::cubic(kStiffness_N_m);
  build.model.forces.add(spring);
  return build.model;
}

/// Angle about z since the start, within half a turn of the one expected.
double angle(const MarkerHistory& frame, Eigen::Index column, double expected) {
  const Quaterniond q = rotation_at(frame.rotation, column);
  const double found = 2 * std::atan2(q.z(), q.w());
  const double turns = std::round((expected - found) / (2 * std::numbers::pi));
  return found + 2 * std::numbers::pi * turns;
}

}  // namespace

TEST_CASE("Andrews' squeezing mechanism is where it must be after 30 ms") {
  const SolverOptions solver{.relative_tolerance = 1e-11, .absolute_tolerance = 1e-13};
  const History history = simulate(mechanism(), solver, {.end_time_s = 0.03, .interval_s = 0.003});
  const Angles expected = body_angles(kPublished);
  Angles found{};
  for (std::size_t k = 0; k < 7; ++k)
    found[k] = angle(history.marker("frame " + std::to_string(k + 1)), 10, expected[k]);
  const Angles q = {found[0], found[1] - found[0], found[2], found[3] - found[4],
                    found[4], found[5] - found[6], found[6]};
  constexpr double kRelative = 1e-8;
  for (std::size_t k = 0; k < 7; ++k) {
    CAPTURE(k);
    CHECK(std::abs(q[k] - kPublished[k]) < kRelative * std::abs(kPublished[k]));
  }
  CHECK(history.redundant_constraints.size() == 9);
  CHECK(history.statistics.max_position_residual < 1e-14);

  // Reactions in the plane are determined, those across it are not.
  for (const JointHistory& joint : history.joints) {
    CAPTURE(joint.name, joint.undetermined);
    CHECK(joint.undetermined.find("force x") == std::string::npos);
    CHECK(joint.undetermined.find("force y") == std::string::npos);
  }
  CHECK(history.joint("E4").undetermined.find("force z") != std::string::npos);
  // The total energy equals the work of the drive.
  const EnergyHistory& energy = history.energy;
  const Eigen::VectorXd balance = energy.kinetic_J + energy.strain_J - energy.work_J;
  CHECK((balance.array() - balance[0]).abs().maxCoeff() <
        1e-9 * energy.work_J.cwiseAbs().maxCoeff());
  CHECK(energy.work_J[10] == Approx(kTorque_Nm * (kPublished[0] - kStart[0])).epsilon(1e-8));
}

TEST_CASE("In-plane reactions of the mechanism are those of a cut") {
  // All bodies K2 … K7 beyond the joints at O, B and A: the ground carries the sum of the rates of
  // momentum of these and K1, less the spring.
  const SolverOptions solver{.relative_tolerance = 1e-10, .absolute_tolerance = 1e-12};
  Model model = mechanism();
  const std::size_t bodies = model.bodies.size();
  for (std::size_t b = 1; b < bodies; ++b) {
    Marker center{"cg " + model.bodies[b].name, b, ""};
    center.position_m = std::get<RigidBody>(model.bodies[b].kind).center_m;
    model.markers.push_back(center);
  }
  const History history = simulate(model, solver, {.end_time_s = 0.02, .interval_s = 0.005});
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k) {
    Vector3d expected = Vector3d::Zero();
    for (std::size_t b = 1; b < bodies; ++b)
      expected += std::get<RigidBody>(model.bodies[b].kind).mass_kg *
                  history.marker("cg " + model.bodies[b].name).acceleration_m_s2.col(k);
    const Vector3d line = history.marker("D").position_m.col(k) - C;
    expected += kStiffness_N_m * (line.norm() - kFreeLength_m) * line.normalized();
    Vector3d found = Vector3d::Zero();
    for (const char* joint : {"O", "B", "A5", "A7"}) found += history.joint(joint).force_N.col(k);
    // The ground's markers have the world's axes.
    CHECK((found - expected).head<2>().norm() < 1e-8 * expected.norm());
  }
}
