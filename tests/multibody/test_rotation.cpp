// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "multibody/numerics/rotation.h"
#include "tests/support/finite_differences.h"
#include "tests/support/marker_motion.h"
#include "tests/support/point_mass_body.h"

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using flexneck::testing::first_derivative;
using flexneck::testing::RandomNumbers;
using flexneck::testing::turned;
using namespace flexneck::multibody;

namespace {

/// Central differences of order 6 with a step of 0.01: truncation and rounding are below 1e-11.
constexpr double kAngleStep = 1e-2;
constexpr double kDifferenceTolerance = 1e-10;
constexpr double kRounding = 1e-14;

/// Tiny and large angles, and both sides of the switch from series to closed form.
const std::vector<double> kAngles = {0, 1e-9, 1e-4, 1e-2, 0.299, 0.301, 1.0, 2.5, 3.1};

Vector3d unskew(const Matrix3d& m) {
  return 0.5 * Vector3d(m(2, 1) - m(1, 2), m(0, 2) - m(2, 0), m(1, 0) - m(0, 1));
}

}  // namespace

TEST_CASE("exponential and logarithm of a rotation agree with axis and angle") {
  RandomNumbers random(1);
  for (const double angle : kAngles) {
    const Vector3d theta = angle * random.vector().normalized();
    CHECK((rotation_exp(theta) - turned(theta)).norm() < kRounding);
    CHECK((quaternion_exp(theta).toRotationMatrix() - turned(theta)).norm() < kRounding);
    CHECK((rotation_log(turned(theta)) - theta).norm() < 10 * kRounding);
  }
}

TEST_CASE("the left Jacobian gives the angular velocity of a changing rotation vector") {
  RandomNumbers random(2);
  for (const double angle : kAngles) {
    const Vector3d theta = angle * random.vector().normalized();
    const Vector3d rate = random.vector();
    // d/dt exp(~theta) exp(~theta)^T = ~omega, omega = J_l thetadot.
    const Matrix3d derivative =
        first_derivative([&](double t) { return Matrix3d(turned(theta + t * rate)); }, kAngleStep);
    const Vector3d omega = unskew(derivative * turned(theta).transpose());
    CHECK((left_jacobian(theta) * rate - omega).norm() < kDifferenceTolerance);
  }
}

TEST_CASE("C_n is the change of the left Jacobian along the motion") {
  RandomNumbers random(3);
  for (const double angle : kAngles) {
    const Vector3d theta = angle * random.vector().normalized();
    const Vector3d rate = random.vector();
    const Vector3d expected = first_derivative(
        [&](double t) { return Vector3d(left_jacobian(theta + t * rate) * rate); }, kAngleStep);
    CHECK((left_jacobian_rate_times_rate(theta, rate) - expected).norm() < kDifferenceTolerance);
  }
}

TEST_CASE("series and closed form of the rotation coefficients meet") {
  // The switch is at 0.3 rad; the closed form of c' has lost three digits there.
  const RotationCoefficients below = rotation_coefficients(0.09 * (1 - 1e-15));
  const RotationCoefficients above = rotation_coefficients(0.09 * (1 + 1e-15));
  CHECK(below.a == Approx(above.a).epsilon(1e-14));
  CHECK(below.b == Approx(above.b).epsilon(1e-14));
  CHECK(below.c == Approx(above.c).epsilon(1e-13));
  CHECK(below.b_rate == Approx(above.b_rate).epsilon(1e-12));
  CHECK(below.c_rate == Approx(above.c_rate).epsilon(1e-12));
}

TEST_CASE("a quaternion's rate turns with the angular velocity in its own axes") {
  RandomNumbers random(4);
  const Quaterniond q = random.rotation();
  const Vector3d omega = random.vector();
  const Eigen::Vector4d expected = first_derivative(
      [&](double t) {
        const Quaterniond moved = q * Quaterniond(turned(t * omega));
        return Eigen::Vector4d(moved.w(), moved.x(), moved.y(), moved.z());
      },
      kAngleStep);
  const Eigen::Vector4d coefficients(q.w(), q.x(), q.y(), q.z());
  CHECK((quaternion_rate(coefficients, omega) - expected).norm() < kDifferenceTolerance);
}
