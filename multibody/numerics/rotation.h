// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fe_modal/body/skew.h"

namespace flexneck::multibody {

/// Coefficients of a rotation vector's series, equations.md section 4, with t = |theta|:
/// a = sin t / t, b = (1 - cos t) / t^2, c = (t - sin t) / t^3, and b' and c', the derivatives of b
/// and c with respect to t, divided by t.
struct RotationCoefficients {
  double a, b, c, b_rate, c_rate;
};

/// Computes the coefficients, below 0.3 rad by the series, whose first neglected term is below
/// 1e-17: the closed forms suffer from cancellation there (at 0.3 rad c' has lost three digits).
inline RotationCoefficients rotation_coefficients(double squared_angle) {
  const double u = squared_angle;
  if (u < 0.09) {
    const auto series = [u](double c0, double c1, double c2, double c3, double c4, double c5) {
      return c0 + u * (c1 + u * (c2 + u * (c3 + u * (c4 + u * c5))));
    };
    return {series(1., -1. / 6, 1. / 120, -1. / 5040, 1. / 362880, -1. / 39916800),
            series(1. / 2, -1. / 24, 1. / 720, -1. / 40320, 1. / 3628800, -1. / 479001600),
            series(1. / 6, -1. / 120, 1. / 5040, -1. / 362880, 1. / 39916800, -1. / 6227020800),
            series(-1. / 12, 1. / 180, -1. / 6720, 1. / 453600, -1. / 47900160, 12. / 87178291200),
            series(-1. / 60, 1. / 1260, -1. / 60480, 1. / 4989600, -1. / 622702080,
                   12. / 1307674368000)};
  }
  const double t = std::sqrt(u);
  const double sine = std::sin(t);
  const double half_sine = std::sin(t / 2);
  const double versine = 2 * half_sine * half_sine;
  return {sine / t, versine / u, (t - sine) / (u * t), (t * sine - 2 * versine) / (u * u),
          (t * versine - 3 * (t - sine)) / (u * u * t)};
}

/// exp(~theta): the rotation by |theta| about theta.
inline Eigen::Matrix3d rotation_exp(const Eigen::Vector3d& theta) {
  const RotationCoefficients k = rotation_coefficients(theta.squaredNorm());
  const Eigen::Matrix3d s = skew(theta);
  return Eigen::Matrix3d::Identity() + k.a * s + k.b * s * s;
}

/// Unit quaternion of exp(~theta).
inline Eigen::Quaterniond quaternion_exp(const Eigen::Vector3d& theta) {
  const double half = theta.norm() / 2;
  const double squared = half * half;
  const double half_sinc =
      0.5 * (half < 1e-3 ? 1 - squared / 6 * (1 - squared / 20) : std::sin(half) / half);
  Eigen::Quaterniond q(std::cos(half), 0, 0, 0);
  q.vec() = half_sinc * theta;
  return q;
}

/// The rotation vector of R, with |theta| <= pi. Inverse of rotation_exp.
inline Eigen::Vector3d rotation_log(const Eigen::Matrix3d& rotation) {
  const Eigen::Quaterniond q(rotation);
  const double sine = q.vec().norm();
  const double cosine = std::abs(q.w());
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  // 2 atan2(sine, cosine) / sine, which tends to 2 / cosine.
  const double factor = sine < 1e-8 ? 2 / cosine : 2 * std::atan2(sine, cosine) / sine;
  return sign * factor * q.vec();
}

/// J_l(theta): maps the rate of a rotation vector to the angular velocity, both in the axes in
/// which the rotation starts: d/dt exp(~theta) = ~(J_l thetadot) exp(~theta).
inline Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& theta) {
  const RotationCoefficients k = rotation_coefficients(theta.squaredNorm());
  const Eigen::Matrix3d s = skew(theta);
  return Eigen::Matrix3d::Identity() + k.b * s + k.c * s * s;
}

/// C_n = (d J_l / dt) thetadot: the angular acceleration for a zero second derivative of the
/// rotation vector. Computed by cross products from equations.md section 4 applied to thetadot: b
/// ~thetadot thetadot drops out.
inline Eigen::Vector3d left_jacobian_rate_times_rate(const Eigen::Vector3d& theta,
                                                     const Eigen::Vector3d& rate) {
  const RotationCoefficients k = rotation_coefficients(theta.squaredNorm());
  const double along = theta.dot(rate);
  const Eigen::Vector3d turned = theta.cross(rate);
  return along * (k.b_rate * turned + k.c_rate * theta.cross(turned)) + k.c * rate.cross(turned);
}

/// d/dt of a unit quaternion (w, x, y, z) of a frame that rotates with `omega`, in its own axes.
inline Eigen::Vector4d quaternion_rate(const Eigen::Vector4d& q, const Eigen::Vector3d& omega) {
  Eigen::Vector4d rate;
  rate[0] = -0.5 * q.tail<3>().dot(omega);
  rate.tail<3>() = 0.5 * (q[0] * omega + q.tail<3>().cross(omega));
  return rate;
}

}  // namespace flexneck::multibody
