// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "fe_modal/body/modal_body.h"

namespace flexneck::testing {

/// Reproducible random numbers in [-1, 1), the same on every platform.
class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned seed) : engine_(seed) {}
  double next() { return static_cast<double>(engine_()) / 2147483648.0 - 1.0; }
  template <typename Derived>
  void fill(Eigen::MatrixBase<Derived>& matrix) {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      for (Eigen::Index i = 0; i < matrix.rows(); ++i) matrix(i, j) = next();
  }
  Eigen::Vector3d vector() {
    Eigen::Vector3d v;
    fill(v);
    return v;
  }
  Eigen::VectorXd vector(Eigen::Index size) {
    Eigen::VectorXd v(size);
    fill(v);
    return v;
  }
  Eigen::Quaterniond rotation() {
    const double w = next();
    return Eigen::Quaterniond(w, next(), next(), next()).normalized();
  }

 private:
  std::mt19937 engine_;
};

/// A body of n point masses with m shapes: all its properties are sums over its points, without any
/// of the formulas under test.
struct PointMassBody {
  Eigen::VectorXd masses_kg;  ///< (n)
  /// m * m displacements of all points, [j * m + l], symmetric in j and l.
  std::vector<Eigen::Matrix3Xd> second_shapes = {};
  fe_modal::ModalBody body;  ///< points, shapes, interfaces and the sums as invariants

  Eigen::Index point_count() const { return masses_kg.size(); }
  /// Position of point k in the body frame at modal coordinates a.
  Eigen::Vector3d point(Eigen::Index k, const Eigen::VectorXd& a) const;
  /// Coefficient of mode k in the second-order displacements of all points.
  double modal_share(std::size_t k, const Eigen::VectorXd& a) const;
  /// Displacement by stress stiffening: the second-order displacement less its modal part.
  Eigen::Vector3d second_order(Eigen::Index k, const Eigen::VectorXd& a) const;
};

/// Invariants by the sums of equations.md section 2.
fe_modal::InertiaInvariants invariants_of_points(const Eigen::VectorXd& masses,
                                                 const Eigen::Matrix3Xd& points,
                                                 const std::vector<Eigen::Matrix3Xd>& shapes);

/// Geometric stiffness of the loads -rho (a + alpha x s0 + w x (w x s0) + psi q'') of unit
/// accelerations.
fe_modal::GeometricStiffness inertial_stiffness_of_points(
    const Eigen::VectorXd& masses, const Eigen::Matrix3Xd& points,
    const std::vector<Eigen::Matrix3Xd>& shapes,
    const std::vector<Eigen::Matrix3Xd>& second_shapes);

/// A random body about 0.2 m long and 2 kg heavy. Interfaces: "root" at the origin, which no mode
/// moves (the body frame is fixed to it); "tip" and "side", which translate with a point and rotate
/// by random modal matrices, a few degrees per centimetre of motion. Nothing else is constrained,
/// so every invariant is full. Its geometric stiffness belongs to random second-order
/// displacements.
PointMassBody make_point_mass_body(unsigned seed, int mode_count = 3, int point_count = 12);

}  // namespace flexneck::testing
