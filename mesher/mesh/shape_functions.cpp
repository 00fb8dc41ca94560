// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/shape_functions.h"

#include <cmath>
#include <vector>

#include <Eigen/LU>

namespace flexneck::mesher {
namespace {

/// Monomials with exponents up to two that an element's shape functions span.
std::vector<Exponents> monomials_of(ElementKind kind) {
  std::vector<Exponents> monomials;
  const int highest_z = dimension(kind) == 3 ? 2 : 0;
  for (int a = 0; a <= 2; ++a) {
    for (int b = 0; b <= 2; ++b) {
      for (int c = 0; c <= highest_z; ++c) {
        if (traits_of(kind).spans({a, b, c})) monomials.push_back({a, b, c});
      }
    }
  }
  return monomials;
}

double power(double x, int exponent) { return exponent == 0 ? 1 : exponent == 1 ? x : x * x; }

/// d/dx x^exponent
double power_slope(double x, int exponent) { return exponent == 0 ? 0 : exponent == 1 ? 1 : 2 * x; }

/// Column n: coefficients of the shape function of node n. They are multiples of 1/8, so rounding
/// makes them exact: a shape function is exactly one at its node and zero at the others.
Eigen::MatrixXd coefficients_of(ElementKind kind, const std::vector<Exponents>& monomials) {
  const auto nodes = reference_nodes(kind);
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Eigen::MatrixXd at_nodes(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::array<double, 3>& x = nodes[static_cast<std::size_t>(i)];
    for (Eigen::Index j = 0; j < n; ++j) {
      const Exponents& e = monomials[static_cast<std::size_t>(j)];
      at_nodes(i, j) = power(x[0], e[0]) * power(x[1], e[1]) * power(x[2], e[2]);
    }
  }
  return (8 * at_nodes.inverse()).array().round() / 8;
}

}  // namespace

ShapeTable tabulate(ElementKind kind, const Eigen::Matrix3Xd& points) {
  const std::vector<Exponents> monomials = monomials_of(kind);
  const Eigen::MatrixXd coefficients = coefficients_of(kind, monomials);
  const auto n = static_cast<Eigen::Index>(monomials.size());
  ShapeTable at_monomials{Eigen::MatrixXd(n, points.cols()), {}};
  for (Eigen::MatrixXd& derivative : at_monomials.derivatives) {
    derivative.resize(n, points.cols());
  }
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    const Eigen::Vector3d x = points.col(q);
    for (Eigen::Index j = 0; j < n; ++j) {
      const Exponents& e = monomials[static_cast<std::size_t>(j)];
      const Eigen::Vector3d value(power(x[0], e[0]), power(x[1], e[1]), power(x[2], e[2]));
      at_monomials.values(j, q) = value.prod();
      at_monomials.derivatives[0](j, q) = power_slope(x[0], e[0]) * value[1] * value[2];
      at_monomials.derivatives[1](j, q) = value[0] * power_slope(x[1], e[1]) * value[2];
      at_monomials.derivatives[2](j, q) = value[0] * value[1] * power_slope(x[2], e[2]);
    }
  }
  ShapeTable table{coefficients.transpose() * at_monomials.values, {}};
  for (std::size_t d = 0; d < 3; ++d) {
    table.derivatives[d] = coefficients.transpose() * at_monomials.derivatives[d];
  }
  return table;
}

}  // namespace flexneck::mesher
