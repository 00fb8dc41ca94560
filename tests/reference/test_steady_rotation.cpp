// SPDX-License-Identifier: GPL-3.0-or-later
// Small motions about steady rotation: published frequencies of a rotating beam, and rotors in
// closed form. Rates and frequencies in rad/s are relative to the hub.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/analysis/campbell.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/joints/joint_kinds.h"
#include "tests/support/test_models.h"

using namespace flexneck::multibody;
using namespace flexneck::testing;
using Catch::Matchers::Contains;
using Eigen::Vector3d;

namespace {

using Complex = std::complex<double>;

/// Tolerance: finite differences leave 1e-10 of the largest stiffness.
constexpr double kTolerance = 1e-7;

PrescribedBody turning(const Vector3d& axis, double rate_rad_s) {
  PrescribedBody hub;
  hub.turn.axis = axis;
  hub.turn.initial_rate_rad_s = rate_rad_s;
  return hub;
}

std::vector<double> angular_frequencies(const Model& model) {
  std::vector<double> found;
  for (const SystemMode& mode : system_modes(model)) {
    CHECK_FALSE(mode.is_unstable());
    found.push_back(2 * std::numbers::pi * mode.frequency_Hz);
  }
  return found;
}

void check_frequencies(const Model& model, std::vector<double> expected) {
  std::sort(expected.begin(), expected.end());
  const std::vector<double> found = angular_frequencies(model);
  REQUIRE(found.size() == expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    CAPTURE(k);
    CHECK(found[k] == Approx(expected[k]).epsilon(kTolerance));
  }
}

/// A clamped beam along z on a hub that rotates about y: bending along y is flap, along x lag.
Model rotating_beam(const Beam& beam, double rate_rad_s) {
  ModelBuilder build;
  DeformableBody blade = deformable(make_beam_body(beam), 0);
  blade.stress_stiffening = true;
  const auto hub = build.body("hub", turning(Vector3d::UnitY(), rate_rad_s));
  const auto arm = build.body("blade", blade);
  build.joint("root", &kFixedJoint, build.marker("hub", hub),
              build.interface_marker("root", arm, "base"));
  build.interface_marker("tip", arm, "top");
  return build.model;
}

constexpr double kMass = 2;
constexpr double kStiffness = 800;  // N/m: 20 rad/s
constexpr double kAxialStiffness = 1800;
constexpr double kTilt = 3;  // N m / rad
constexpr double kTwist = 5;
constexpr double kDiameter_kg_m2 = 0.01;
constexpr double kPolar_kg_m2 = 0.018;

/// A disc on a massless shaft that rotates about z with the hub.
struct Rotor {
  ModelBuilder build;
  std::size_t ground, hub, disc;
};

Rotor rotor(double rate_rad_s, double damping = 0) {
  Rotor made;
  ModelBuilder& build = made.build;
  const auto ground = build.ground();
  const auto hub = build.body("hub", turning(Vector3d::UnitZ(), rate_rad_s));
  const auto disc = build.body(
      "disc", RigidBody{kMass, Vector3d::Zero(),
                        Vector3d(kDiameter_kg_m2, kDiameter_kg_m2, kPolar_kg_m2).asDiagonal()});
  made.ground = build.marker("bearing", ground);
  made.hub = build.marker("hub", hub);
  made.disc = build.marker("disc", disc);
  Bushing shaft{"shaft", made.hub, made.disc};
  shaft.stiffness.diagonal() << kStiffness, kStiffness, kAxialStiffness, kTilt, kTilt, kTwist;
  shaft.damping.diagonal().head<2>().setConstant(damping);
  build.model.forces.add(shaft);
  return made;
}

/// Flap of a disc whose whirl in space, w, obeys I w^2 - Ip rate w = k: backward and forward.
std::array<double, 2> whirls(double rate) {
  const double drag = kPolar_kg_m2 * rate / (2 * kDiameter_kg_m2);
  const double root = std::sqrt(drag * drag + kTilt / kDiameter_kg_m2);
  return {drag - root, drag + root};
}

void add_bearing(Rotor& made, double along_x, double along_y, double damping) {
  Bushing bearing{"bearing", made.ground, made.disc};
  bearing.stiffness.diagonal().head<2>() << along_x, along_y;
  bearing.damping.diagonal().head<2>().setConstant(damping);
  made.build.model.forces.add(bearing);
}

}  // namespace

TEST_CASE("flap and lag of a rotating beam are the published ones") {
  // Wright, Smith, Thresher and Wang, J. Appl. Mech. 49 (1982) 197, no hub radius, in units of
  // sqrt(EI / rho A) / L^2 at rates in the same unit; lag^2 = flap^2 - rate^2.
  constexpr std::array<std::array<double, 2>, 5> kPublished = {
      {{0, 3.5160}, {2, 4.1373}, {4, 5.5850}, {6, 7.3604}, {12, 13.1702}}};
  const auto [rate, flap] = GENERATE_REF(from_range(kPublished));
  const double lag = std::sqrt(flap * flap - rate * rate);
  if (rate == 6) CHECK(lag == Approx(4.2633).margin(1e-4));
  CAPTURE(rate);
  Beam beam;
  beam.fore_aft_Hz = beam.lateral_Hz = 10;
  const double unit = 2 * std::numbers::pi * 10 / (kClampedFree[0] * kClampedFree[0]);
  // Ritz's method with the shapes of the beam at rest overestimates: with one shape as Southwell's
  // coefficient, with four by 1e-3 at rate 12, and with its third power below.
  beam.fore_aft_modes = beam.lateral_modes = 1;
  const std::vector<double> southwell = angular_frequencies(rotating_beam(beam, rate * unit));
  CHECK(southwell[1] / unit ==
        Approx(std::sqrt(kPublished[0][1] * kPublished[0][1] + 1.193 * rate * rate)).epsilon(3e-4));
  beam.fore_aft_modes = beam.lateral_modes = 4;
  const std::vector<double> found = angular_frequencies(rotating_beam(beam, rate * unit));
  const double lacking = 1e-3 * std::pow(rate / 12, 3);
  CHECK(found[0] / unit == Approx(lag).epsilon((2e-5 + lacking) * flap * flap / (lag * lag)));
  CHECK(found[1] / unit == Approx(flap).epsilon(2e-5 + lacking));
}

TEST_CASE("a mass on a slider that turns is stretched outwards and softened") {
  constexpr double kLength = 0.5, kStretch = 0.1, kLinear = 100, kCubic = 3e3, kBlock = 1.5;
  const double force = kLinear * kStretch + kCubic * std::pow(kStretch, 3);
  const double rate = std::sqrt(force / (kBlock * (kLength + kStretch)));
  ModelBuilder build;
  const auto hub = build.body("hub", turning(Vector3d::UnitZ(), rate));
  const auto block =
      build.body("block", RigidBody{kBlock, Vector3d::Zero(), 0.01 * Eigen::Matrix3d::Identity()},
                 {{kLength, 0, 0}});
  const auto centre = build.marker("centre", hub);
  const auto on_block = build.marker("block", block);
  build.joint("rail", &kPrismaticJoint, centre, on_block, Vector3d::UnitX());
  MarkerSpring spring{"spring", centre, on_block, kLength, {}};
  spring.resistance.positive.curve = LoadCurve::cubic(kLinear, 0, kCubic);
  build.model.forces.add(spring);
  check_frequencies(build.model, {std::sqrt((kLinear + 3 * kCubic * kStretch * kStretch) / kBlock -
                                            rate * rate)});
}

TEST_CASE(
    "a rotor whirls forwards and backwards as its closed form says, below and above its "
    "critical speed") {
  const double rate = GENERATE(5.0, 12.0, 30.0);
  CAPTURE(rate);
  Rotor made = rotor(rate);
  made.build.model.gravity_m_s2 = {0, 0, -kGravity};
  const auto [backward, forward] = whirls(rate);
  const double k = std::sqrt(kStiffness / kMass);
  check_frequencies(
      made.build.model,
      {std::abs(k - rate), k + rate, std::sqrt(kAxialStiffness / kMass), std::abs(forward - rate),
       std::abs(backward - rate), std::sqrt(kTwist / kPolar_kg_m2)});
}

TEST_CASE("damping that turns with the rotor makes it unstable above its critical speed") {
  constexpr double kInner = 1.5, kOuter = 0.4, kBearing = 100;
  const double rate = GENERATE(12.0, 40.0);
  CAPTURE(rate);
  Rotor made = rotor(rate, kInner);
  add_bearing(made, kBearing, kBearing, kOuter);
  // z'' + 2 i rate z' - rate^2 z + (inner z' + outer (z' + i rate z) + (k + kb) z) / m = 0.
  const Complex i(0, 1);
  const Complex b = (kInner + kOuter) / kMass + 2. * i * rate;
  const Complex c = (kStiffness + kBearing) / kMass - rate * rate + i * rate * kOuter / kMass;
  const Complex root = std::sqrt(b * b / 4. - c);
  const std::array<Complex, 2> expected = {-b / 2. + root, -b / 2. - root};
  const std::vector<SystemMode> found = system_modes(made.build.model);
  for (const Complex& lambda : expected) {
    const double f = std::abs(lambda) / (2 * std::numbers::pi);
    const auto mode =
        std::min_element(found.begin(), found.end(), [f](const auto& x, const auto& y) {
          return std::abs(x.frequency_Hz - f) < std::abs(y.frequency_Hz - f);
        });
    CHECK(mode->frequency_Hz == Approx(f).epsilon(kTolerance));
    CHECK(mode->damping_ratio == Approx(-lambda.real() / std::abs(lambda)).margin(1e-6));
    CHECK(mode->growth_rate_1_s == Approx(std::max(0.0, lambda.real())).margin(1e-5));
  }
  // Its outer damping stabilises it up to sqrt((k + kb) / m) (1 + outer / inner), 26.9 rad/s.
  const bool is_unstable = std::any_of(found.begin(), found.end(),
                                       [](const SystemMode& mode) { return mode.is_unstable(); });
  CHECK(is_unstable == (rate > 30));
}

TEST_CASE("a Campbell diagram follows each whirl through crossings and the critical speed") {
  const std::vector<double> rates = {0, 4, 8, 16, 24, 32, 40};
  const CampbellDiagram diagram = campbell_diagram(rotor(7).build.model, rates);
  REQUIRE(diagram.modes.size() == 6);
  // Each closed form is one of the rows, at all rates.
  const double k = std::sqrt(kStiffness / kMass);
  std::vector<std::vector<double>> expected(6);
  for (const double rate : rates) {
    const auto [backward, forward] = whirls(rate);
    const std::array<double, 6> at = {std::abs(k - rate),
                                      k + rate,
                                      std::sqrt(kAxialStiffness / kMass),
                                      std::abs(forward - rate),
                                      std::abs(backward - rate),
                                      std::sqrt(kTwist / kPolar_kg_m2)};
    for (std::size_t n = 0; n < 6; ++n) expected[n].push_back(at[n]);
  }
  for (const std::vector<double>& row : expected) {
    double nearest = 1e9;
    for (const std::vector<SystemMode>& mode : diagram.modes) {
      double apart = 0;
      for (std::size_t r = 0; r < rates.size(); ++r)
        apart = std::max(apart, std::abs(2 * std::numbers::pi * mode[r].frequency_Hz - row[r]));
      nearest = std::min(nearest, apart);
    }
    CHECK(nearest < 1e-4);
  }
}

TEST_CASE("what makes steady rotation periodic is refused by name") {
  const auto refused = [](const Model& model, const std::string& reason) {
    CHECK_THROWS_WITH(linearise(model, LinearisedAt::equilibrium), Contains(reason));
    CHECK_THROWS_AS(linearise(model, LinearisedAt::equilibrium), flexneck::InputError);
  };
  Rotor made = rotor(10);
  made.build.model.gravity_m_s2 = {0, 0.1, -kGravity};
  refused(made.build.model, "gravity is not parallel to the axis");

  made = rotor(10);
  add_bearing(made, 100, 100.001, 0);
  refused(made.build.model, "not rotationally symmetric about the axis");
  // Four springs are isotropic to the first order; three of them are not. This holds for the size
  // of a watch and of a wind turbine.
  for (const double size : {2e-3, 1.0, 1e3}) {
    CAPTURE(size);
    made = rotor(10);
    Model& model = made.build.model;
    std::get<RigidBody>(model.bodies.back().kind).inertia_kg_m2 *= size * size;
    model.forces.of<Bushing>().back().stiffness.diagonal().tail<3>() *= size * size;
    for (const Vector3d& from :
         {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(-1, 0, 0), Vector3d(0, -1, 0)}) {
      const std::string name = "spring " + std::to_string(model.forces.of<MarkerSpring>().size());
      MarkerSpring spring{name, made.build.marker(name, 0, size * from), made.disc, 0.9 * size, {}};
      spring.resistance.positive.curve = LoadCurve::cubic(50);
      model.forces.add(spring);
    }
    CHECK(system_modes(model).size() == 6);
    model.forces.of<MarkerSpring>().pop_back();
    refused(model, "not rotationally symmetric about the axis");
  }

  made = rotor(10);
  made.build.joint("clamp", &kSphericalJoint, made.ground,
                   made.build.marker("rim", 2, {0.1, 0, 0}));
  made.build.model.bodies[0].initial_pose.position_m = {0.1, 0, 0};
  refused(made.build.model, "joint 'clamp' connects a body to one that does not rotate");

  made = rotor(10);
  made.build.body("other", turning(Vector3d::UnitZ(), 11));
  refused(made.build.model, "prescribed bodies 'hub' and 'other' rotate at different rates");
  made.build.model.bodies.back().kind = turning(-Vector3d::UnitZ(), -10);
  CHECK(system_modes(made.build.model).size() == 6);
  std::get<PrescribedBody>(made.build.model.bodies.back().kind).turn.point_m = {0.1, 0, 0};
  refused(made.build.model, "about different axes");

  made = rotor(10);
  std::get<PrescribedBody>(made.build.model.bodies[1].kind).turn.acceleration_rad_s2 =
      constant_table(1);
  refused(made.build.model, "'hub' does not rotate at a constant rate");

  made = rotor(10);
  made.build.force("push", made.disc, Vector3d::UnitZ(),
                   TimeTable({0, 1}, {0, 1}, TimeTable::Outside::constant));
  refused(made.build.model, "force 'push' varies with time");
  made.build.model.forces.of<PointForce>()[0] = {"push", made.disc, Vector3d::UnitX(),
                                                 constant_table(1)};
  refused(made.build.model, "force 'push' is not parallel to the axis");

  CHECK_THROWS_WITH(campbell_diagram(rotor(0).build.model, {0, 1}),
                    Contains("needs a prescribed body that rotates"));
  CHECK_THROWS_WITH(campbell_diagram(rotor(1).build.model, {1, 1}), Contains("ascend"));
}
