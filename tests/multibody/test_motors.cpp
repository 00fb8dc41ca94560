// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Catch::Matchers::Contains;
using Eigen::Index;
using Eigen::Vector3d;

namespace {

constexpr double kMotionEnd_s = 0.5;
const SolverOptions kSolver{.relative_tolerance = 1e-10, .absolute_tolerance = 1e-12};
const Vector3d kAxis(0.6, 0, 0.8);

/// A motion of four turns and a little back.
SmoothMotion winding() {
  return SmoothMotion::of_displacement([](double t) { return 60 * t - 3 * std::sin(9 * t); },
                                       kMotionEnd_s);
}

/// A pendulum whose pivot rotates by winding(), prescribed by a motor or by a prescribed body.
ModelBuilder turned_pendulum(bool by_motor) {
  ModelBuilder build;
  build.model.gravity_m_s2 = {1, 2, -9};
  PrescribedBody prescribed;
  if (!by_motor) {
    prescribed.turn.axis = kAxis;
    prescribed.turn.motion = winding();
  }
  const Vector3d spin = winding().velocity_m_s(0) * kAxis;
  const Vector3d place(0.3, 0.1, 0);
  const Vector3d elbow(0.2, -0.4, 0.1);
  const auto base = build.body("base", prescribed);
  const auto rotor = build.body("rotor", make_head(), {place}, spin.cross(place), spin);
  const auto bob = build.body("bob", make_head(), {place + elbow}, spin.cross(place + elbow), spin);
  const auto joint =
      build.joint("drive", by_motor ? &kRevoluteJoint : &kFixedJoint, build.marker("base", base),
                  build.marker("hub", rotor, -place), kAxis);
  if (by_motor)
    build.model.joints[joint].motors = {{"motor", JointCoordinate::angle, 0, {0, {}, winding()}}};
  build.joint("elbow", &kRevoluteJoint, build.marker("rotor end", rotor, elbow),
              build.marker("bob", bob), Vector3d(0, 0.8, -0.6));
  return build;
}

}  // namespace

TEST_CASE("a motor on the ground moves what hangs on it as a prescribed body does, and as hard") {
  const History motor =
      simulate(turned_pendulum(true).model, kSolver, {.end_time_s = kMotionEnd_s});
  const History prescribed =
      simulate(turned_pendulum(false).model, kSolver, {.end_time_s = kMotionEnd_s});
  const Index last = motor.time_s.size() - 1;
  REQUIRE(prescribed.time_s.size() == last + 1);
  for (const char* const name : {"rotor end", "bob"}) {
    const MarkerHistory& a = motor.marker(name);
    const MarkerHistory& b = prescribed.marker(name);
    CHECK((a.position_m - b.position_m).cwiseAbs().maxCoeff() < 1e-7);
    CHECK((a.acceleration_m_s2 - b.acceleration_m_s2).norm() < 1e-6 * b.acceleration_m_s2.norm());
  }
  // Joint histories are in the axes of marker i, which rotates with the prescribed body.
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(winding().displacement_m(motor.time_s[last]), kAxis).toRotationMatrix();
  const auto compare = [&](const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
    CHECK((a.col(last) - R * b.col(last)).norm() < 1e-5 * b.col(last).norm());
  };
  compare(motor.joints[0].force_N, prescribed.joints[0].force_N);
  compare(motor.joints[0].moment_Nm, prescribed.joints[0].moment_Nm);
  CHECK(motor.energy.work_J[last] == Approx(prescribed.energy.work_J[last]).epsilon(1e-6));
}

TEST_CASE("a motor between two free bodies moves each by its share, and its work is their energy") {
  constexpr double kMass_i = 2;
  constexpr double kMass_j = 3;
  const auto stroke = [](double t) { return 0.4 + 0.2 * std::sin(12 * t); };
  ModelBuilder build;
  const auto mass = [](double kg) {
    return RigidBody{kg, Vector3d::Zero(), 0.1 * Eigen::Matrix3d::Identity()};
  };
  const double rate = 0.2 * 12;
  const double share = kMass_i / (kMass_i + kMass_j);
  const auto i = build.body("i", mass(kMass_i), {}, -(1 - share) * rate * kAxis);
  const auto j = build.body("j", mass(kMass_j), {0.4 * kAxis}, share * rate * kAxis);
  const auto joint =
      build.joint("piston", &kPrismaticJoint, build.marker("i", i), build.marker("j", j), kAxis);
  build.model.joints[joint].motors = {
      {"drive",
       JointCoordinate::distance,
       0,
       {0, {}, SmoothMotion::of_displacement(stroke, kMotionEnd_s)}}};
  const History history = simulate(build.model, kSolver, {.end_time_s = kMotionEnd_s});
  const auto& at_i = history.marker("i");
  const auto& at_j = history.marker("j");
  for (Index k = 0; k < history.time_s.size(); k += 20) {
    const double t = history.time_s[k];
    const double moved = stroke(t) - 0.4;
    CAPTURE(t);
    CHECK((at_j.position_m.col(k) - (0.4 + share * moved) * kAxis).norm() < 1e-9);
    CHECK((at_i.position_m.col(k) + (1 - share) * moved * kAxis).norm() < 1e-9);
    const double force = kMass_j * share * -0.2 * 144 * std::sin(12 * t);
    CHECK((history.joints[0].force_N.col(k) - force * kAxis).norm() < 1e-6);
    CHECK(history.energy.work_J[k] ==
          Approx(history.energy.kinetic_J[k] - history.energy.kinetic_J[0]).margin(1e-7));
  }
}

TEST_CASE("a joint starts where its motor says, and motors that make no sense are refused") {
  ModelBuilder build = turned_pendulum(true);
  JointMotor& motor = build.model.joints[0].motors[0];
  motor.start = 0.1;
  CHECK_THROWS_WITH(simulate(build.model, kSolver, {}),
                    Contains("joint 'drive'") && Contains("0 m and 0.1 rad apart"));
  motor.start = 4 * std::numbers::pi;  // the same place
  CHECK_NOTHROW(simulate(build.model, kSolver, {.end_time_s = 0.01}));
  CHECK_THROWS_WITH(simulate(build.model, {.formulation = Formulation::recursive}, {}),
                    Contains("has the motor 'motor'") && Contains("descriptor"));
  motor.coordinate = JointCoordinate::distance;
  CHECK_THROWS_WITH(check(build.model), Contains("motor 'motor'") && Contains("is revolute"));
  motor.coordinate = JointCoordinate::angle;
  build.model.joints[0].motors.push_back(motor);
  build.model.joints[0].motors[1].name = "second";
  CHECK_THROWS_WITH(check(build.model), Contains("already has a motor for its angle"));
}
