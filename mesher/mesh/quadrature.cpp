// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string>
#include <vector>

#include "geometry/foundation/error.h"
#include "geometry/foundation/symmetric_pairs.h"
#include "mesher/mesh/shape_functions.h"

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
    default: {
      const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(6.0 / 5));
      const double outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(6.0 / 5));
      const double heavy = (18 + std::sqrt(30.0)) / 36;
      const double light = (18 - std::sqrt(30.0)) / 36;
      return {{-outer, light}, {-inner, heavy}, {inner, heavy}, {outer, light}};
    }
  }
}

/// Points and weights of a rule under construction.
struct Points {
  std::vector<Eigen::Vector3d> places;
  std::vector<double> weights;

  void add(const Eigen::Vector3d& place, double weight) {
    places.push_back(place);
    weights.push_back(weight);
  }
};

Points product_rule(int n, int dimension) {
  const std::vector<LinePoint> line = gauss_line(n);
  const std::vector<LinePoint> none = {{0, 1}};
  Points rule;
  for (const LinePoint& a : line) {
    for (const LinePoint& b : line) {
      for (const LinePoint& c : dimension == 3 ? line : none) {
        rule.add({a.position, b.position, c.position}, a.weight * b.weight * c.weight);
      }
    }
  }
  return rule;
}

/// The product rule on the square, mapped onto the triangle: an edge collapses to a point, and the
/// map's determinant takes one degree.
Points collapsed_rule(int n) {
  Points rule;
  const Points square = product_rule(n, 2);
  for (std::size_t q = 0; q < square.places.size(); ++q) {
    const Eigen::Vector3d u = (square.places[q].array() + 1) / 2;
    rule.add({u[0], u[1] * (1 - u[0]), 0}, square.weights[q] / 4 * (1 - u[0]));
  }
  return rule;
}

/// The point whose barycentric coordinates are all `a`, except for corner k of `corners`, which has
/// the rest.
Eigen::Vector3d near_corner(int k, int corners, double a) {
  Eigen::Vector3d place = Eigen::Vector3d::Constant(a);
  if (k > 0) place[k - 1] = 1 - (corners - 1) * a;
  if (corners == 3) place[2] = 0;
  return place;
}

/// Adds the orbit of the point whose barycentric coordinates are all `a` except for one.
void add_corner_orbit(Points& rule, int corners, double a, double weight) {
  for (int k = 0; k < corners; ++k) rule.add(near_corner(k, corners, a), weight);
}

Points triangle_rule(int n) {
  Points rule;
  switch (n) {
    case 1:
      rule.add({1.0 / 3, 1.0 / 3, 0}, 0.5);
      return rule;
    case 2:
      add_corner_orbit(rule, 3, 1.0 / 6, 1.0 / 6);
      return rule;
    case 3: {
      const double root = std::sqrt(15.0);
      rule.add({1.0 / 3, 1.0 / 3, 0}, 9.0 / 80);
      add_corner_orbit(rule, 3, (6 + root) / 21, (155 + root) / 2400);
      add_corner_orbit(rule, 3, (6 - root) / 21, (155 - root) / 2400);
      return rule;
    }
    default:
      return collapsed_rule(n);
  }
}

Points tetrahedron_rule(int n) {
  Points rule;
  switch (n) {
    case 1:
      rule.add(Eigen::Vector3d::Constant(0.25), 1.0 / 6);
      return rule;
    case 2:
      add_corner_orbit(rule, 4, (5 - std::sqrt(5.0)) / 20, 1.0 / 24);
      return rule;
    default: {
      add_corner_orbit(rule, 4, 0.31088591926330060980, 0.11268792571801585080 / 6);
      add_corner_orbit(rule, 4, 0.092735250310891226402, 0.073493043116361949544 / 6);
      // Edge midpoints moved inwards: two barycentric coordinates are b, two the rest.
      const double b = 0.045503704125649649492;
      const double rest = 0.5 - b;
      for (const Eigen::Vector3d& place :
           {Eigen::Vector3d(rest, b, b), Eigen::Vector3d(b, rest, b), Eigen::Vector3d(b, b, rest),
            Eigen::Vector3d(b, rest, rest), Eigen::Vector3d(rest, b, rest),
            Eigen::Vector3d(rest, rest, b)}) {
        rule.add(place, 0.042546020777081466438 / 6);
      }
      return rule;
    }
  }
}

Points prism_rule(int n) {
  Points rule;
  const Points triangle = triangle_rule(n);
  for (const LinePoint& c : gauss_line(n)) {
    for (std::size_t q = 0; q < triangle.places.size(); ++q) {
      rule.add(triangle.places[q] + c.position * Eigen::Vector3d::UnitZ(),
               triangle.weights[q] * c.weight);
    }
  }
  return rule;
}

/// Gauss-Jacobi rule for the integral of (1 - z)^2 f(z) over [0, 1]: eigenvalues of the matrix of
/// the recurrence of the orthogonal polynomials (Golub and Welsch, Math. Comp. 23 (1969) 221).
std::vector<LinePoint> gauss_jacobi_line(int n) {
  constexpr double kTotalWeight = 1.0 / 3;
  Eigen::MatrixXd recurrence = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < n; ++k) {
    const double twice = 2 * k + 2;
    recurrence(k, k) = -4 / (twice * (twice + 2));
    if (k == 0) continue;
    recurrence(k, k - 1) = 2.0 * k * (k + 2) / twice / std::sqrt(twice * twice - 1);
  }
  const SymmetricPairs pairs = symmetric_pairs(recurrence);
  std::vector<LinePoint> rule;
  for (int q = 0; q < n; ++q) {
    const double first = pairs.vectors(0, q);
    rule.push_back({(1 + pairs.values[q]) / 2, kTotalWeight * first * first});
  }
  return rule;
}

/// The product rule on the cube, mapped onto the pyramid: a face collapses to the apex.
Points pyramid_rule(int n) {
  Points rule;
  const Points base = product_rule(n, 2);
  for (const LinePoint& c : gauss_jacobi_line(n)) {
    for (std::size_t q = 0; q < base.places.size(); ++q) {
      rule.add((1 - c.position) * base.places[q] + c.position * Eigen::Vector3d::UnitZ(),
               base.weights[q] * c.weight);
    }
  }
  return rule;
}

Points points_of(ReferenceShape shape, int n) {
  switch (shape) {
    case ReferenceShape::hexahedron:
      return product_rule(n, 3);
    case ReferenceShape::prism:
      return prism_rule(n);
    case ReferenceShape::tetrahedron:
      return tetrahedron_rule(n);
    case ReferenceShape::pyramid:
      return pyramid_rule(n);
    case ReferenceShape::quadrilateral:
      return product_rule(n, 2);
    case ReferenceShape::triangle:
      return triangle_rule(n);
  }
  return {};
}

}  // namespace

Quadrature gauss_rule(ElementKind kind, int n) {
  const int strongest = shape_of(kind) == ReferenceShape::tetrahedron ? 3 : 4;
  if (n < 1 || n > strongest) {
    throw InputError("quadrature rule of strength " + std::to_string(n) + " on " +
                     std::string(name_of(kind)) + ": expected 1 to " + std::to_string(strongest));
  }
  const Points points = points_of(shape_of(kind), n);
  const auto count = static_cast<Eigen::Index>(points.weights.size());
  Quadrature rule{Eigen::Matrix3Xd(3, count),
                  Eigen::Map<const Eigen::VectorXd>(points.weights.data(), count)};
  for (Eigen::Index q = 0; q < count; ++q) {
    rule.points.col(q) = points.places[static_cast<std::size_t>(q)];
  }
  return rule;
}

}  // namespace flexneck::mesher
