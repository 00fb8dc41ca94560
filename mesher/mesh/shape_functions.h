// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// A quadrature rule on the reference element.
struct Quadrature {
  Eigen::Matrix3Xd points;  ///< (3, q) reference coordinates
  Eigen::VectorXd weights;  ///< (q)
};

/// Tensor-product Gauss rule with n points in each direction, exact to degree 2n - 1; n = 1 … 4.
Quadrature gauss_rule(ElementKind kind, int n);

/// Shape functions at points of the reference element.
struct ShapeTable {
  Eigen::MatrixXd values;                      ///< (n, q)
  std::array<Eigen::MatrixXd, 3> derivatives;  ///< by reference coordinate, each (n, q)
};

ShapeTable tabulate(ElementKind kind, const Eigen::Matrix3Xd& points);

}  // namespace flexneck::mesher
