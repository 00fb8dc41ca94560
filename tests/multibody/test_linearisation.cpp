// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "multibody/analysis/campbell.h"
#include "multibody/analysis/linearisation.h"
#include "multibody/joints/joint_kinds.h"
#include "multibody/numerics/rotation.h"
#include "tests/support/dense_solvers.h"
#include "tests/support/point_mass_body.h"

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::Matrix3Xcd;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using flexneck::testing::make_point_mass_body;
using namespace flexneck::multibody;
using flexneck::skew;

namespace {

constexpr double kGravity = 9.81;
/// Tolerance: central differences over 1e-5 rad leave about 1e-10.
constexpr double kTolerance = 1e-8;

double hertz(double omega) { return omega / (2 * std::numbers::pi); }

RigidBody rod(double mass, double length) {
  RigidBody body;
  body.mass_kg = mass;
  body.center_m = {0, 0, -length / 2};
  const double inertia = mass * length * length / 12;
  body.inertia_kg_m2 = Vector3d(inertia, inertia, inertia / 10).asDiagonal();
  return body;
}

/// Two rods on revolute joints, hanging from the ground.
Model double_pendulum(double m1, double l1, double m2, double l2) {
  Model model;
  model.gravity_m_s2 = {0, 0, -kGravity};
  model.bodies = {{"ground", PrescribedBody{}, {}},
                  {"upper", rod(m1, l1), {}},
                  {"lower", rod(m2, l2), {{0, 0, -l1}}}};
  model.markers = {{"pivot", 0, ""},
                   {"upper top", 1, ""},
                   {"upper end", 1, ""},
                   {"lower top", 2, ""},
                   {"lower end", 2, ""}};
  model.markers[2].position_m = {0, 0, -l1};
  model.markers[4].position_m = {0, 0, -l2};
  model.joints = {{"first", &kRevoluteJoint, 0, 1}, {"second", &kRevoluteJoint, 2, 3}};
  return model;
}

/// Matrices K and M for its angles.
std::pair<Matrix2d, Matrix2d> double_pendulum_matrices(double m1, double l1, double m2, double l2) {
  // M = [m1 l1^2/3 + m2 l1^2, m2 l1 l2/2; ., m2 l2^2/3], K = g diag(m1 l1/2 + m2 l1, m2 l2/2).
  Matrix2d M, K;
  M << m1 * l1 * l1 / 3 + m2 * l1 * l1, m2 * l1 * l2 / 2, m2 * l1 * l2 / 2, m2 * l2 * l2 / 3;
  K << kGravity * (m1 * l1 / 2 + m2 * l1), 0, 0, kGravity * m2 * l2 / 2;
  return {K, M};
}

/// A modal body clamped at its root to a prescribed body, with a head on its tip.
Model clamped(double zeta, double head_kg, int modes) {
  Model model;
  const auto body = make_point_mass_body(61, modes).body;
  model.bodies.push_back({"ground", PrescribedBody{}, {}});
  model.bodies.push_back({"flexible", DeformableBody{body, VectorXd::Constant(modes, zeta)}, {}});
  model.markers = {{"wall", 0, ""}, {"root", 1, "root"}};
  model.joints.push_back({"clamp", &kFixedJoint, 0, 1});
  if (head_kg > 0) {
    RigidBody head;
    head.mass_kg = head_kg;
    head.center_m = {0.02, 0.01, 0.05};
    head.inertia_kg_m2 = head_kg * Vector3d(0.004, 0.006, 0.005).asDiagonal();
    model.bodies.push_back({"head", head, {body.interface("tip").position_m}});
    model.markers.push_back({"tip", 1, "tip"});
    model.markers.push_back({"head", 2, ""});
    model.joints.push_back({"top", &kFixedJoint, 2, 3});
  }
  return model;
}

}  // namespace

TEST_CASE("a double pendulum swings with its closed-form frequencies in both planes") {
  const double m1 = 2, l1 = 0.5, m2 = 1, l2 = 0.3;
  Model model = double_pendulum(m1, l1, m2, l2);
  const auto [K, M] = double_pendulum_matrices(m1, l1, m2, l2);
  const VectorXd eigenvalues = flexneck::testing::dense_pairs(K, M).values;
  const auto modes = system_modes(model);
  REQUIRE(modes.size() == 2);
  for (Index k = 0; k < 2; ++k) {
    const SystemMode& mode = modes[static_cast<std::size_t>(k)];
    CHECK(mode.frequency_Hz == Approx(hertz(std::sqrt(eigenvalues[k]))).epsilon(kTolerance));
    CHECK(mode.damped_frequency_Hz == Approx(mode.frequency_Hz).epsilon(kTolerance));
    CHECK(std::abs(mode.damping_ratio) < kTolerance);
  }
  // On spherical joints each rod swings in two planes; rotations about the vertical have no
  // restoring force.
  for (Joint& joint : model.joints) joint.kind = &kSphericalJoint;
  const auto free_modes = system_modes(model);
  REQUIRE(free_modes.size() == 6);
  CHECK(free_modes[1].frequency_Hz == 0);
  for (std::size_t k = 2; k < 6; ++k)
    CHECK(free_modes[k].frequency_Hz == Approx(modes[k < 4 ? 0 : 1].frequency_Hz).epsilon(1e-7));
}

TEST_CASE("shapes of a double pendulum are the eigenvectors of its closed form") {
  const double m1 = 2, l1 = 0.5, m2 = 1, l2 = 0.3;
  Model model = double_pendulum(m1, l1, m2, l2);
  const auto [K, M] = double_pendulum_matrices(m1, l1, m2, l2);
  const flexneck::testing::DensePairs eigen = flexneck::testing::dense_pairs(K, M);
  const auto at = GENERATE(LinearisedAt::equilibrium, LinearisedAt::given);
  const std::vector<ModeShape> modes = linearise(model, at);
  REQUIRE(modes.size() == 2);
  for (Index k = 0; k < 2; ++k) {
    const ModeShape& found = modes[static_cast<std::size_t>(k)];
    CHECK(found.mode.frequency_Hz == Approx(hertz(std::sqrt(eigen.values[k]))).epsilon(kTolerance));
    // A rotation by phi about y moves points at l below by -l phi along x.
    const Eigen::Vector2d phi = eigen.vectors.col(k);
    const Eigen::Vector2d ends(-l1 * phi[0], -l1 * phi[0] - l2 * phi[1]);
    const double largest = std::abs(ends[0]) > std::abs(ends[1]) ? ends[0] : ends[1];
    const Matrix3Xcd& moved = found.translation;
    CHECK(std::abs(moved(0, 2) - ends[0] / largest) < 1e-7);
    CHECK(std::abs(moved(0, 3) - ends[0] / largest) < 1e-7);
    CHECK(std::abs(moved(0, 4) - ends[1] / largest) < 1e-7);
    CHECK(moved.bottomRows<2>().cwiseAbs().maxCoeff() < 1e-7);
    CHECK(moved.leftCols<2>().cwiseAbs().maxCoeff() < 1e-7);
    CHECK(std::abs(found.rotation(1, 1) - phi[0] / largest) < 1e-6);
    CHECK(std::abs(found.rotation(1, 3) - phi[1] / largest) < 1e-6);
  }
}

TEST_CASE("about a hub that turns, a linear beam is softer by the square of the spin") {
  // f^2 = f0^2 - spin^2 in the plane, f0 perpendicular to it: neither a run nor an equilibrium is
  // needed.
  constexpr double kSpin = 12;
  Model model = clamped(0, 0, 1);
  PrescribedBody hub;
  hub.turn.axis = Vector3d::UnitZ();
  hub.turn.initial_rate_rad_s = kSpin;
  model.bodies[0].kind = hub;
  model.bodies[1].initial_angular_velocity_rad_s = {0, 0, kSpin};
  const auto points = make_point_mass_body(61, 1);
  const auto& body = points.body;
  // Fraction of the mode's unit modal mass in motions across the axis.
  const double in_plane =
      (body.shapes[0].topRows<2>().colwise().squaredNorm() * points.masses_kg).value();
  REQUIRE(in_plane > 0.1);
  const double omega = 2 * std::numbers::pi * body.frequencies_Hz[0];
  // In joint coordinates about the given state; in all bodies' coordinates about steady rotation,
  // where the beam is bent outwards, which makes no difference for a linear body.
  const auto at = GENERATE(LinearisedAt::given, LinearisedAt::equilibrium);
  const std::vector<ModeShape> modes = linearise(model, at);
  REQUIRE(modes.size() == 1);
  CHECK(modes[0].mode.frequency_Hz ==
        Approx(hertz(std::sqrt(omega * omega - kSpin * kSpin * in_plane))).epsilon(kTolerance));
}

TEST_CASE("a closed loop that is given in motion is not linearised") {
  Model loop = double_pendulum(1, 1, 1, 1);
  loop.joints.push_back({"back", &kFixedJoint, 5, 4});
  loop.markers.push_back({"below", 0, ""});
  loop.markers.back().position_m = {0, 0, -2};
  CHECK(linearise(loop, LinearisedAt::given).empty());
  loop.bodies[1].initial_angular_velocity_rad_s = {0, 1, 0};
  CHECK_THROWS_WITH(linearise(loop, LinearisedAt::given),
                    Catch::Matchers::Contains("closed loops of joints"));
}

TEST_CASE("a clamped modal body alone has its own frequencies and damping") {
  const double zeta = GENERATE(0.0, 0.2, 0.9, 1.5);
  CAPTURE(zeta);
  const Model model = clamped(zeta, 0, 3);
  const auto modes = system_modes(model);
  REQUIRE(modes.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const double f = 4.0 + 3.0 * static_cast<double>(k);
    CHECK(modes[k].frequency_Hz == Approx(f).epsilon(kTolerance));
    CHECK(modes[k].damping_ratio == Approx(zeta).margin(kTolerance));
    const double damped = zeta < 1 ? f * std::sqrt(1 - zeta * zeta) : 0;
    CHECK(modes[k].damped_frequency_Hz == Approx(damped).margin(kTolerance * f));
  }
}

TEST_CASE("a head on a modal body swings as the minimal-coordinate form says") {
  const double zeta = 0.3;
  const Model model = clamped(zeta, 3, 4);
  const auto& body = std::get<DeformableBody>(model.bodies[1].kind).modes;
  const auto& tip = body.interface("tip");
  const auto& head = std::get<RigidBody>(model.bodies[2].kind);
  // equations.md section 6 at a = 0 and rest; all quantities of the head are about its joint.
  const Eigen::Matrix3d hS = skew(head.mass_kg * head.center_m);
  const Eigen::Matrix3d hJ =
      head.inertia_kg_m2 - head.mass_kg * skew(head.center_m) * skew(head.center_m);
  const MatrixXd psi = tip.translation;
  const MatrixXd mu = tip.rotation;
  const MatrixXd M = MatrixXd::Identity(4, 4) + psi.transpose() * (head.mass_kg * psi - hS * mu) +
                     mu.transpose() * (hS * psi + hJ * mu);
  const VectorXd omega = 2 * std::numbers::pi * body.frequencies_Hz;
  MatrixXd A = MatrixXd::Zero(8, 8);
  A.topRightCorner(4, 4).setIdentity();
  A.bottomLeftCorner(4, 4) = -M.inverse() * MatrixXd(omega.cwiseAbs2().asDiagonal());
  A.bottomRightCorner(4, 4) = -M.inverse() * MatrixXd((2 * zeta * omega).asDiagonal());
  std::vector<std::complex<double>> expected;
  const Eigen::VectorXcd eigenvalues = flexneck::testing::complex_eigenvalues(A);
  for (const auto& lambda : eigenvalues)
    if (lambda.imag() > 0) expected.push_back(lambda);
  std::sort(expected.begin(), expected.end(),
            [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
  const auto modes = system_modes(model);
  REQUIRE(expected.size() == 4);
  REQUIRE(modes.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    CHECK(modes[k].frequency_Hz == Approx(hertz(std::abs(expected[k]))).epsilon(kTolerance));
    CHECK(modes[k].damped_frequency_Hz == Approx(hertz(expected[k].imag())).epsilon(kTolerance));
    CHECK(modes[k].damping_ratio ==
          Approx(-expected[k].real() / std::abs(expected[k])).epsilon(kTolerance));
  }
}

TEST_CASE("overdamped modes pair their real eigenvalues by shape") {
  // Two uncoupled oscillators, rotated so that the matrices are full; their eigenvalues interlace:
  // w = 10, zeta = 2 gives -2.68 and -37.3; w = 12, zeta = 1.2 gives -6.44 and -22.4.
  const Eigen::Rotation2Dd turn(0.7);
  const Matrix2d R = turn.toRotationMatrix();
  const Matrix2d K = R * Eigen::Vector2d(100, 144).asDiagonal() * R.transpose();
  const Matrix2d C = R * Eigen::Vector2d(40, 28.8).asDiagonal() * R.transpose();
  const auto modes = modes_of(K, C);
  REQUIRE(modes.size() == 2);
  CHECK(modes[0].frequency_Hz == Approx(hertz(10)).epsilon(1e-12));
  CHECK(modes[0].damping_ratio == Approx(2).epsilon(1e-12));
  CHECK(modes[1].frequency_Hz == Approx(hertz(12)).epsilon(1e-12));
  CHECK(modes[1].damping_ratio == Approx(1.2).epsilon(1e-12));
}

TEST_CASE("an unstable motion has its eigenvalues and a growth rate") {
  // Divergence, growing oscillation and growing overdamped motion: lambda = +-2, 0.3 +- 4i, 0.5 and
  // 8.
  const Matrix2d R = Eigen::Rotation2Dd(0.4).toRotationMatrix();
  const auto modes_with = [&](double k1, double c1, double k2, double c2) {
    return modes_of(R * Eigen::Vector2d(k1, k2).asDiagonal() * R.transpose(),
                    R * Eigen::Vector2d(c1, c2).asDiagonal() * R.transpose());
  };
  const auto modes = modes_with(-4, 0, 16.09, -0.6);
  REQUIRE(modes.size() == 2);
  CHECK(modes[0].frequency_Hz == 0);
  CHECK(modes[0].growth_rate_1_s == Approx(2).epsilon(1e-12));
  CHECK(modes[1].frequency_Hz == Approx(hertz(std::sqrt(16.09))).epsilon(1e-12));
  CHECK(modes[1].damped_frequency_Hz == Approx(hertz(4)).epsilon(1e-12));
  CHECK(modes[1].damping_ratio == Approx(-0.3 / std::sqrt(16.09)).epsilon(1e-12));
  CHECK(modes[1].growth_rate_1_s == Approx(0.3).epsilon(1e-12));
  const auto creeping = modes_with(4, -8.5, 100, 0.1);
  CHECK(creeping[0].frequency_Hz == Approx(hertz(2)).epsilon(1e-12));
  CHECK(creeping[0].growth_rate_1_s == Approx(8).epsilon(1e-12));
  CHECK_FALSE(creeping[1].is_unstable());
  // Without stiffness the growing eigenvalue has no partner.
  CHECK(modes_with(0, -0.7, 100, 0)[0].growth_rate_1_s == Approx(0.7).epsilon(1e-12));
}

TEST_CASE("about a kink a model swings on the mean stiffness of both sides, and says so") {
  // A weight on a rail, with a spring that is stiffer when lifted.
  Model model;
  model.bodies = {{"ground", PrescribedBody{}, {}},
                  {"weight", RigidBody{2, Vector3d::Zero(), Eigen::Matrix3d::Identity()}, {}}};
  model.markers = {{"ground.at", 0, ""}, {"weight.at", 1, ""}};
  model.joints = {{"rail", &kPrismaticJoint, 0, 1}};
  model.joints[0].axis = Vector3d::UnitZ();
  JointResistance spring;
  spring.name = "spring";
  spring.coordinate = JointCoordinate::distance;
  spring.resistance.positive.curve = LoadCurve::cubic(400);
  spring.resistance.negative.curve = LoadCurve::cubic(100);
  model.forces.add(std::move(spring));
  const auto at = GENERATE(LinearisedAt::equilibrium, LinearisedAt::given);
  model.gravity_m_s2.setZero();
  const SystemMode at_kink = linearise(model, at).front().mode;
  CHECK(at_kink.frequency_Hz == Approx(hertz(std::sqrt(250.0 / 2))));
  CHECK_THAT(at_kink.kink, Catch::Matchers::Contains("resistance 'spring'"));
  model.gravity_m_s2 = {0, 0, -kGravity};
  if (at == LinearisedAt::given) model.bodies[1].initial_pose.position_m.z() = -0.1;
  const SystemMode below = linearise(model, at).front().mode;
  CHECK(below.frequency_Hz == Approx(hertz(std::sqrt(100.0 / 2))).epsilon(kTolerance));
  CHECK(below.kink.empty());

  model.gravity_m_s2.setZero();
  model.bodies[1].initial_pose = {};
  auto& ground = std::get<PrescribedBody>(model.bodies[0].kind);
  ground.turn.axis = Vector3d::UnitZ();
  ground.turn.initial_rate_rad_s = 1;
  const SystemMode turning = campbell_diagram(model, {3}).modes.front().front();
  CHECK(turning.frequency_Hz == Approx(hertz(std::sqrt(250.0 / 2))));
  CHECK_THAT(turning.kink, Catch::Matchers::Contains("resistance 'spring'"));
}
