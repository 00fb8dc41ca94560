// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// A quadrature rule on the reference element.
struct Quadrature {
  Eigen::Matrix3Xd points;  ///< (3, q) reference coordinates
  Eigen::VectorXd weights;  ///< (q), all positive
};

/// Quadrature rule of strength n = 1 … 4, on the tetrahedron 1 … 3. Hexahedra and quadrilaterals:
/// the Gauss product rule with n points in each direction, exact to degree 2n - 1 in each.
/// Simplices: exact to the total degree 1, 2, 5, 6 with 1, 3, 7, 16 points on the triangle and 1,
/// 4, 14 on the tetrahedron (n = 3: Radon's rule, and Walkington's, 2000; n = 4: collapsed Gauss
/// product). Prisms: the rule of the triangle times that of the line. Pyramids: collapsed Gauss
/// product, n^3 points, exact to the total degree 2n - 1.
/// @throws InputError for another n.
Quadrature gauss_rule(ElementKind kind, int n);

/// Shape functions at points of the reference element.
struct ShapeTable {
  Eigen::MatrixXd values;                      ///< (n, q)
  std::array<Eigen::MatrixXd, 3> derivatives;  ///< by reference coordinate, each (n, q); at the
                                               ///< apex of a pyramid those along its axis
};

ShapeTable tabulate(ElementKind kind, const Eigen::Matrix3Xd& points);

}  // namespace flexneck::mesher
