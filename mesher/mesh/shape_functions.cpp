// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/shape_functions.h"

#include <cmath>
#include <string>
#include <vector>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

struct LinePoint {
  double position;
  double weight;
};

/// Gauss-Legendre rule on [-1, 1] in closed form.
std::vector<LinePoint> gauss_line(int n) {
  switch (n) {
    case 1:
      return {{0, 2}};
    case 2: {
      const double x = std::sqrt(1.0 / 3);
      return {{-x, 1}, {x, 1}};
    }
    case 3: {
      const double x = std::sqrt(3.0 / 5);
      return {{-x, 5.0 / 9}, {0, 8.0 / 9}, {x, 5.0 / 9}};
    }
    case 4: {
      const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(6.0 / 5));
      const double outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(6.0 / 5));
      const double heavy = (18 + std::sqrt(30.0)) / 36;
      const double light = (18 - std::sqrt(30.0)) / 36;
      return {{-outer, light}, {-inner, heavy}, {inner, heavy}, {outer, light}};
    }
    default:
      throw InputError("Gauss rule with " + std::to_string(n) +
                       " points in a direction: expected 1 to 4");
  }
}

struct LineFunction {
  double value;
  double derivative;
};

/// Quadratic Lagrange function at x that is 1 at `node` (one of -1, 0, 1) and 0 at the two others.
LineFunction lagrange(double node, double x) {
  if (node == 0) return {1 - x * x, -2 * x};
  return {x * (x + node) / 2, x + node / 2};
}

}  // namespace

Quadrature gauss_rule(ElementKind kind, int n) {
  const std::vector<LinePoint> line = gauss_line(n);
  const std::vector<LinePoint> none = {{0, 1}};
  const std::vector<LinePoint>& third = dimension(kind) == 3 ? line : none;
  const auto count = static_cast<Eigen::Index>(line.size() * line.size() * third.size());
  Quadrature rule{Eigen::Matrix3Xd(3, count), Eigen::VectorXd(count)};
  Eigen::Index q = 0;
  for (const LinePoint& a : line) {
    for (const LinePoint& b : line) {
      for (const LinePoint& c : third) {
        rule.points.col(q) << a.position, b.position, c.position;
        rule.weights[q++] = a.weight * b.weight * c.weight;
      }
    }
  }
  return rule;
}

ShapeTable tabulate(ElementKind kind, const Eigen::Matrix3Xd& points) {
  const std::span<const std::array<double, 3>> nodes = reference_nodes(kind);
  const auto n = static_cast<Eigen::Index>(nodes.size());
  const bool volume = dimension(kind) == 3;
  ShapeTable table;
  table.values.resize(n, points.cols());
  for (Eigen::MatrixXd& derivative : table.derivatives) derivative.resize(n, points.cols());
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const std::array<double, 3>& node = nodes[static_cast<std::size_t>(i)];
      const LineFunction a = lagrange(node[0], points(0, q));
      const LineFunction b = lagrange(node[1], points(1, q));
      const LineFunction c = volume ? lagrange(node[2], points(2, q)) : LineFunction{1, 0};
      table.values(i, q) = a.value * b.value * c.value;
      table.derivatives[0](i, q) = a.derivative * b.value * c.value;
      table.derivatives[1](i, q) = a.value * b.derivative * c.value;
      table.derivatives[2](i, q) = a.value * b.value * c.derivative;
    }
  }
  return table;
}

}  // namespace flexneck::mesher
