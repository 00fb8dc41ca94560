// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include "multibody/descriptor/node_kinematics.h"
#include "multibody/numerics/rotation.h"
#include "tests/support/finite_differences.h"
#include "tests/support/marker_motion.h"
#include "tests/support/point_mass_body.h"

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using flexneck::testing::first_derivative;
using flexneck::testing::make_point_mass_body;
using flexneck::testing::MarkerMotion;
using flexneck::testing::PointMassBody;
using flexneck::testing::RandomNumbers;
using flexneck::testing::second_derivative;
using namespace flexneck::multibody;

namespace {

/// Step at which differences of order 6 leave less than 1e-8 of accelerations of the order of 10.
constexpr double kStep = 4e-3;
constexpr double kTolerance = 1e-7;

/// Rotation vector of a moving marker since t = 0, world: its first and second derivatives there
/// are Om and Omd.
Vector3d turn_since_start(const MarkerMotion& motion, double t) {
  return rotation_log(motion.frame(t).R * motion.frame(0).R.transpose());
}

const flexneck::fe_modal::GeometricStiffness::OfInterface& loads_on(const PointMassBody& points,
                                                                    const std::string& interface) {
  const auto& all = points.body.geometric_stiffness->interfaces;
  return interface == all[0].name ? all[0] : all[1];
}

}  // namespace

TEST_CASE("velocity and acceleration of an interface are derivatives of its position") {
  const PointMassBody points = make_point_mass_body(21, 3);
  const Index m = 3;
  RandomNumbers random(22);
  Body body;
  const bool stiffens = GENERATE(false, true);
  body.kind = DeformableBody{points.body, VectorXd::Zero(m), {}, stiffens};
  Marker marker;
  marker.interface = "tip";
  marker.rotation = random.rotation();
  const NodeConstants node(body, marker);
  const BodyConstants constants(std::get<DeformableBody>(body.kind));
  BodyTerms terms(constants);
  terms.x = random.vector();
  terms.A = random.rotation().toRotationMatrix();
  terms.a = 0.1 * random.vector(m);  // the interface is turned by about half a radian
  const VectorXd V = random.vector(6 + m);
  const VectorXd Vdot = 5 * random.vector(6 + m);
  NodeKinematics motion(6 + m);
  update_configuration(node, terms, motion);
  update_velocities(node, terms, V, motion);

  const MarkerMotion truth{points.body.interface("tip"),
                           marker.rotation.toRotationMatrix(),
                           terms.x,
                           terms.A,
                           terms.a,
                           V,
                           Vdot,
                           stiffens ? &loads_on(points, "tip") : nullptr,
                           stiffens ? points.body.geometric_stiffness->modal_acceleration
                                    : std::vector<Eigen::MatrixXd>()};
  const auto position = [&](double t) { return truth.frame(t).p; };
  const auto turn = [&](double t) { return turn_since_start(truth, t); };
  REQUIRE(motion.theta.norm() > 0.2);
  CHECK((motion.p - truth.frame(0).p).norm() < 1e-14);
  CHECK((motion.R - truth.frame(0).R).norm() < 1e-14);
  CHECK((motion.P * V - first_derivative(position, kStep)).norm() < kTolerance);
  CHECK((motion.W * V - first_derivative(turn, kStep)).norm() < kTolerance);
  CHECK((motion.pd - motion.P * V).norm() < 1e-13);
  CHECK((motion.Om - motion.W * V).norm() < 1e-13);
  CHECK((motion.P * Vdot + motion.gp - second_derivative(position, kStep)).norm() < kTolerance);
  CHECK((motion.W * Vdot + motion.gr - second_derivative(turn, kStep)).norm() < kTolerance);
}

TEST_CASE("the generalised force of a point force does its virtual work") {
  const PointMassBody points = make_point_mass_body(23, 3);
  RandomNumbers random(24);
  Body body;
  const bool stiffens = GENERATE(false, true);
  body.kind = DeformableBody{points.body, VectorXd::Zero(3), {}, stiffens};
  Marker marker;
  marker.interface = "side";
  const NodeConstants node(body, marker);
  const BodyConstants constants(std::get<DeformableBody>(body.kind));
  BodyTerms terms(constants);
  terms.x = random.vector();
  terms.A = random.rotation().toRotationMatrix();
  terms.a = 0.1 * random.vector(3);
  NodeKinematics motion(9);
  update_configuration(node, terms, motion);
  const Vector3d force = 100 * random.vector();
  const VectorXd generalised = motion.P.transpose() * force;
  for (Index i = 0; i < 9; ++i) {
    // dW / d(variation i) = F . dp / d(variation i).
    const MarkerMotion varied{points.body.interface("side"),
                              Matrix3d::Identity(),
                              terms.x,
                              terms.A,
                              terms.a,
                              VectorXd::Unit(9, i),
                              VectorXd::Zero(9),
                              stiffens ? &loads_on(points, "side") : nullptr,
                              stiffens ? points.body.geometric_stiffness->modal_acceleration
                                       : std::vector<Eigen::MatrixXd>()};
    const double work =
        first_derivative([&](double t) { return force.dot(varied.frame(t).p); }, kStep);
    CHECK(generalised[i] == Approx(work).margin(1e-8 * force.norm()));
  }
}
