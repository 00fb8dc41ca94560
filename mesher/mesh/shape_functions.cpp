// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/shape_functions.h"

#include <algorithm>
#include <array>
#include <vector>

#include <Eigen/LU>

namespace flexneck::mesher {
namespace {

/// Functions that span an element's shape functions.
std::vector<Exponents> functions_of(ElementKind kind) {
  std::vector<Exponents> functions;
  const int highest_z = dimension(kind) == 3 ? 2 : 0;
  for (int a = 0; a <= 2; ++a) {
    for (int b = 0; b <= 2; ++b) {
      for (int c = 0; c <= highest_z; ++c) {
        if (traits_of(kind).spans({a, b, c})) functions.push_back({a, b, c});
      }
    }
  }
  return functions;
}

double power(double x, int exponent) { return exponent == 0 ? 1 : exponent == 1 ? x : x * x; }

/// d/dx x^exponent
double power_slope(double x, int exponent) { return exponent == 0 ? 0 : exponent == 1 ? 1 : 2 * x; }

struct Term {
  double value;
  Eigen::Vector3d slope;  ///< derivatives by reference coordinate
};

Term monomial(const Exponents& e, const Eigen::Vector3d& x) {
  const Eigen::Vector3d f(power(x[0], e[0]), power(x[1], e[1]), power(x[2], e[2]));
  return {f.prod(),
          {power_slope(x[0], e[0]) * f[1] * f[2], f[0] * power_slope(x[1], e[1]) * f[2],
           f[0] * f[1] * power_slope(x[2], e[2])}};
}

/// A function of a pyramid and its derivatives; at the apex, where they depend on the direction,
/// those along the axis.
Term pyramid_term(const Exponents& e, const Eigen::Vector3d& x) {
  const double w = 1 - x[2];
  const int m = std::max(e[0], e[1]);
  const double a = w > 0 ? x[0] / w : 0;
  const double b = w > 0 ? x[1] / w : 0;
  const double z = power(x[2], e[2]);
  const double in_base = power(a, e[0]) * power(b, e[1]);
  const double w_less = m == 0 ? 0 : power(w, m - 1);  // factor of terms that vanish where m does
  return {in_base * power(w, m) * z,
          {power_slope(a, e[0]) * power(b, e[1]) * w_less * z,
           power(a, e[0]) * power_slope(b, e[1]) * w_less * z,
           in_base * ((e[0] + e[1] - m) * w_less * z + power(w, m) * power_slope(x[2], e[2]))}};
}

Term term_of(ElementKind kind, const Exponents& e, const Eigen::Vector3d& x) {
  return shape_of(kind) == ReferenceShape::pyramid ? pyramid_term(e, x) : monomial(e, x);
}

/// Coefficients of the shape functions; column n belongs to node n. They are multiples of 1/8, so
/// rounding makes them exact: a shape function is exactly one at its node and zero at the others.
Eigen::MatrixXd coefficients_of(ElementKind kind, const std::vector<Exponents>& functions) {
  const auto nodes = reference_nodes(kind);
  const auto n = static_cast<Eigen::Index>(nodes.size());
  Eigen::MatrixXd at_nodes(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d x(nodes[static_cast<std::size_t>(i)].data());
    for (Eigen::Index j = 0; j < n; ++j) {
      at_nodes(i, j) = term_of(kind, functions[static_cast<std::size_t>(j)], x).value;
    }
  }
  return (8 * at_nodes.inverse()).array().round() / 8;
}

}  // namespace

ShapeTable tabulate(ElementKind kind, const Eigen::Matrix3Xd& points) {
  const std::vector<Exponents> functions = functions_of(kind);
  const Eigen::MatrixXd coefficients = coefficients_of(kind, functions);
  const auto n = static_cast<Eigen::Index>(functions.size());
  ShapeTable terms{Eigen::MatrixXd(n, points.cols()), {}};
  for (Eigen::MatrixXd& derivative : terms.derivatives) derivative.resize(n, points.cols());
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const Term term = term_of(kind, functions[static_cast<std::size_t>(j)], points.col(q));
      terms.values(j, q) = term.value;
      for (std::size_t d = 0; d < 3; ++d)
        terms.derivatives[d](j, q) = term.slope[static_cast<Eigen::Index>(d)];
    }
  }
  ShapeTable table{coefficients.transpose() * terms.values, {}};
  for (std::size_t d = 0; d < 3; ++d)
    table.derivatives[d] = coefficients.transpose() * terms.derivatives[d];
  return table;
}

}  // namespace flexneck::mesher
