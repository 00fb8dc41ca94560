// SPDX-License-Identifier: GPL-3.0-or-later
// Closed loops: redundant rows, motors that prescribe all motions, fitting initial velocities.
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/simulation/simulation.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Catch::Matchers::Contains;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

RigidBody bar(double length) {
  return {1, {length / 2, 0, 0}, Vector3d(1e-3, 0.02, 0.02).asDiagonal()};
}

/// Cranks of 0.2 and 0.4 m, 0.5 m apart, and a coupler of 0.5 m, on revolute joints about z; all
/// velocities are open. The crank starts at 1 rad.
/// @param skew_rad  misalignment of the last joint, about x
ModelBuilder four_bar(double skew_rad = 0) {
  constexpr double kCoupler = 0.47391117506640706;
  constexpr double kRocker = 1.4380176710407748;
  const auto about_z = [](double angle) {
    return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
  };
  const Quaterniond skew(Eigen::AngleAxisd(skew_rad, Vector3d::UnitX()));
  ModelBuilder build;
  const auto ground = build.ground();
  const Vector3d crank_end = about_z(1) * Vector3d(0.2, 0, 0);
  const auto crank = build.body("crank", bar(0.2), {Vector3d::Zero(), about_z(1)});
  const auto coupler = build.body("coupler", bar(0.5), {crank_end, about_z(kCoupler)});
  const auto rocker = build.body("rocker", bar(0.4), {{0.5, 0, 0}, about_z(kRocker)});
  const auto pin = [&](const char* name, std::size_t i, std::size_t j) {
    build.joint(name, &kRevoluteJoint, i, j, Vector3d::UnitZ());
  };
  pin("A", build.marker("A", ground), build.marker("a", crank));
  pin("B", build.marker("crank b", crank, {0.2, 0, 0}), build.marker("b", coupler));
  pin("C", build.marker("coupler c", coupler, {0.5, 0, 0}), build.marker("c", rocker, {0.4, 0, 0}));
  pin("D", build.marker("D", ground, {0.5, 0, 0}, skew),
      build.marker("d", rocker, Vector3d::Zero(), about_z(kRocker).conjugate() * skew));
  for (Body& body : build.model.bodies) body.velocities_are_open = body.name != "ground";
  build.model.gravity_m_s2 = {0, -kGravity, 0};
  return build;
}

void add_motor(Model& model, std::size_t joint, double start, double rate, double acceleration) {
  model.joints[joint].motors.push_back(
      {"motor of " + model.joints[joint].name, JointCoordinate::angle, start,
       PrescribedCoordinate(rate, constant_table(acceleration), {})});
}

const SolverOptions kTight{.relative_tolerance = 1e-9, .absolute_tolerance = 1e-12};
const OutputOptions kOutput{.end_time_s = 0.5, .interval_s = 0.05};

}  // namespace

TEST_CASE("velocities that nobody gives fit the motor that starts a loop") {
  Model model = four_bar().model;
  // The crank starts at rest except for rounding of its rate, and at speed.
  const double rate = GENERATE(1e-17, 8.0);
  add_motor(model, 0, 1, rate, 2);
  const History history = simulate(model, kTight, kOutput);
  const MarkerHistory& crank = history.marker("a");
  for (Eigen::Index k = 0; k < history.time_s.size(); ++k)
    CHECK(crank.angular_velocity_rad_s(2, k) == Approx(rate + 2 * history.time_s[k]).margin(1e-9));
  CHECK(history.freedoms == 0);
  // A velocity that is given is not changed.
  model.bodies[2].velocities_are_open = false;
  if (rate == 8.0) CHECK_THROWS_WITH(simulate(model, kTight, kOutput), Contains("separate with"));
}

TEST_CASE("generalised-alpha steps as finely as motors that drive everything ask for") {
  Model model = four_bar().model;
  add_motor(model, 0, 1, 8, 0);
  SolverOptions alpha{.relative_tolerance = 1e-7, .absolute_tolerance = 1e-10};
  alpha.integrator = Integrator::generalised_alpha;
  const History found = simulate(model, alpha, kOutput);
  const History exact = simulate(model, kTight, kOutput);
  for (const char* joint : {"A", "B", "C"}) {
    const Eigen::Matrix3Xd& force = exact.joint(joint).force_N;
    CHECK((found.joint(joint).force_N - force).topRows<2>().cwiseAbs().maxCoeff() <
          1e-4 * force.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("motors that contradict each other are refused with that reason") {
  Model model = four_bar().model;
  add_motor(model, 0, 1, 0, 2);
  add_motor(model, 3, 0, 0, 2);
  CHECK_THROWS_WITH(
      simulate(model, kTight, kOutput),
      Contains("motor 'motor of A' and motor 'motor of D' prescribe the same degree of freedom"));
}

TEST_CASE("pins that are out of line by little are told of, and how many freedoms are left") {
  const History aligned = simulate(four_bar().model, kTight, kOutput);
  CHECK(aligned.freedoms == 1);
  CHECK(aligned.redundant_constraints.size() == 3);
  CHECK(aligned.warnings.empty());
  const History skewed = simulate(four_bar(GENERATE(3e-5, 1e-4, 1e-3)).model, kTight, kOutput);
  CHECK(skewed.freedoms == 0);
  REQUIRE(!skewed.warnings.empty());
  CHECK_THAT(skewed.warnings[0], Contains("joint 'D'") && Contains("misaligned"));
}

TEST_CASE("a ring of pins moves as one of balls, its rank found once") {
  // A half ring of links between two points of the ground, in its plane.
  const auto ring = [](const JointKind* kind) {
    constexpr int kLinks = 60;
    ModelBuilder build;
    const auto ground = build.ground();
    const auto at = [](int k) {
      const double angle = std::acos(-1.0) * (1 + double(k) / kLinks);
      return Vector3d(std::cos(angle), 0, std::sin(angle));
    };
    const auto left = build.marker("left", ground, at(0));
    const auto right = build.marker("right", ground, at(kLinks));
    auto before = left;
    for (int k = 0; k < kLinks; ++k) {
      const Vector3d along = at(k + 1) - at(k);
      const Quaterniond turn(Eigen::AngleAxisd(std::atan2(-along[2], along[0]), Vector3d::UnitY()));
      const std::string name = std::to_string(k);
      const double length = along.norm();
      const RigidBody link{0.1, {length / 2, 0, 0}, Vector3d(1e-6, 2e-5, 2e-5).asDiagonal()};
      const auto body = build.body("link " + name, link, {at(k), turn});
      // The first joint prevents the links from rotating about themselves.
      build.joint("joint " + name, k == 0 ? &kRevoluteJoint : kind, before,
                  build.marker("begin " + name, body));
      before = build.marker("end " + name, body, {length, 0, 0});
    }
    build.joint("last", kind, before, right);
    build.model.gravity_m_s2 = {0.5, 0, -kGravity};
    return simulate(build.model, {}, {.end_time_s = 0.2, .interval_s = 0.05});
  };
  const History pins = ring(&kRevoluteJoint);
  const History balls = ring(&kSphericalJoint);
  CHECK(pins.redundant_constraints.size() == 3);
  CHECK(pins.freedoms == 58);
  for (const char* marker : {"end 20", "end 30", "end 45"})
    CHECK((pins.marker(marker).position_m - balls.marker(marker).position_m).cwiseAbs().maxCoeff() <
          1e-5);
}
