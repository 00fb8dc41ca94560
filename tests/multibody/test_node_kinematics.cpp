// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "multibody/node_kinematics.h"
#include "multibody/rotation.h"
#include "tests/support/finite_differences.h"
#include "tests/support/point_mass_body.h"

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using flexneck::testing::first_derivative;
using flexneck::testing::make_point_mass_body;
using flexneck::testing::PointMassBody;
using flexneck::testing::RandomNumbers;
using flexneck::testing::second_derivative;
using namespace flexneck::multibody;

namespace {

/// At this step differences of order 6 leave below 1e-8 of accelerations of the order of 10.
constexpr double kStep = 4e-3;
constexpr double kTolerance = 1e-7;

Matrix3d turned(const Vector3d& theta) {
  const double angle = theta.norm();
  if (angle == 0) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, theta / angle).toRotationMatrix();
}

/// A deformable body on a given motion through t = 0 with velocities V and accelerations Vdot:
/// rotation A exp(~(w t + wdot t^2 / 2)), everything else a parabola.
struct Motion {
  const flexneck::fe_modal::Interface& place;
  Matrix3d R0;
  Vector3d x;
  Matrix3d A;
  VectorXd a, V, Vdot;

  VectorXd displacement(double t) const { return t * V + t * t / 2 * Vdot; }
  Vector3d position(double t) const {
    const VectorXd d = displacement(t);
    return x + d.head<3>() +
           A * turned(d.segment<3>(3)) *
               (place.position_m + place.translation * (a + d.tail(a.size())));
  }
  Matrix3d rotation(double t) const {
    const VectorXd d = displacement(t);
    return A * turned(d.segment<3>(3)) * turned(place.rotation * (a + d.tail(a.size()))) * R0;
  }
  /// Rotation vector since t = 0, world: its first and second derivatives there are Om and Omd.
  Vector3d turn(double t) const { return rotation_log(rotation(t) * rotation(0).transpose()); }
};

}  // namespace

TEST_CASE("velocity and acceleration of an interface are derivatives of its position") {
  const PointMassBody points = make_point_mass_body(21, 3);
  const Index m = 3;
  RandomNumbers random(22);
  Body body;
  body.kind = DeformableBody{points.body, VectorXd::Zero(m)};
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

  const Motion truth{points.body.interface("tip"),
                     marker.rotation.toRotationMatrix(),
                     terms.x,
                     terms.A,
                     terms.a,
                     V,
                     Vdot};
  const auto position = [&](double t) { return truth.position(t); };
  const auto turn = [&](double t) { return truth.turn(t); };
  REQUIRE(motion.theta.norm() > 0.2);
  CHECK((motion.p - truth.position(0)).norm() < 1e-14);
  CHECK((motion.R - truth.rotation(0)).norm() < 1e-14);
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
  body.kind = DeformableBody{points.body, VectorXd::Zero(3)};
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
    const Motion varied{
        points.body.interface("side"), Matrix3d::Identity(), terms.x, terms.A, terms.a,
        VectorXd::Unit(9, i),          VectorXd::Zero(9)};
    const double work =
        first_derivative([&](double t) { return force.dot(varied.position(t)); }, kStep);
    CHECK(generalised[i] == Approx(work).margin(1e-8 * force.norm()));
  }
}
