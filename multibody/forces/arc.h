// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "multibody/numerics/rotation.h"

// Helpers of force elements that model parts bent to arcs (equations.md section 8).
namespace flexneck::multibody {

/// Sinc of half an angle, chord over arc, and its gradient with respect to the transverse part of
/// the rotation vector.
struct ArcShortening {
  explicit ArcShortening(const Eigen::Vector3d& across) {
    const RotationCoefficients k = rotation_coefficients(across.squaredNorm() / 4);
    ratio = k.a;
    gradient = (k.c - k.b) / 4 * across;
  }

  double ratio;
  Eigen::Vector3d gradient;
};

/// The part of a rotation vector transverse to a direction, which may be zero.
inline Eigen::Vector3d part_across(const Eigen::Vector3d& theta, const Eigen::Vector3d& length) {
  const double squared = length.squaredNorm();
  if (squared == 0) return Eigen::Vector3d::Zero();
  return theta - (theta.dot(length) / squared) * length;
}

/// Half of a rotation vector, with operations on it by cross products.
class HalfTurn {
 public:
  explicit HalfTurn(const Eigen::Vector3d& theta)
      : theta_(theta),
        half_(theta / 2),
        squared_(theta.squaredNorm()),
        k_(rotation_coefficients(squared_ / 4)) {}

  /// Rotates a vector by the half rotation; the next function rotates back.
  Eigen::Vector3d turned(const Eigen::Vector3d& v) const {
    const Eigen::Vector3d once = half_.cross(v);
    return v + k_.a * once + k_.b * half_.cross(once);
  }
  Eigen::Vector3d turned_back(const Eigen::Vector3d& v) const {
    const Eigen::Vector3d once = half_.cross(v);
    return v - k_.a * once + k_.b * half_.cross(once);
  }
  /// Returns J_l(theta / 2)^T v.
  Eigen::Vector3d of_rate(const Eigen::Vector3d& v) const {
    const Eigen::Vector3d once = half_.cross(v);
    return v - k_.b * once + k_.c * half_.cross(once);
  }
  /// Returns J_l(theta)^-T v = v + theta x v / 2 + d theta x (theta x v), d = (1 - t/2 cot t/2) /
  /// t^2.
  Eigen::Vector3d to_moment(const Eigen::Vector3d& v) const {
    const double cosine = 1 - k_.b * squared_ / 4;
    // Cancellation in d does not matter: the term is small there.
    const double d = squared_ > 1e-12 ? (1 - cosine / k_.a) / squared_ : 1. / 12;
    const Eigen::Vector3d once = theta_.cross(v);
    return v + once / 2 + d * theta_.cross(once);
  }

 private:
  Eigen::Vector3d theta_, half_;
  double squared_;
  RotationCoefficients k_;
};

}  // namespace flexneck::multibody
