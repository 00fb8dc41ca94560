// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <set>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::mesher {
namespace {

constexpr double kRounding = 1e-14;

Eigen::Matrix3Xd node_points(ElementKind kind) {
  const auto nodes = reference_nodes(kind);
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) = Eigen::Map<const Eigen::Vector3d>(nodes[i].data());
  }
  return points;
}

/// Points without symmetry inside the reference element; flat for surfaces.
Eigen::Matrix3Xd scattered_points(ElementKind kind) {
  Eigen::Matrix3Xd points(3, 4);
  points.row(0) << 0.31, 0.07, 0.05, 0.59;
  points.row(1) << 0.22, 0.13, 0.77, 0.18;
  points.row(2) << 0.18, 0.41, 0.03, 0.22;
  if (dimension(kind) == 2) points.row(2).setZero();
  return points;
}

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

/// int_-1^1 x^k dx
double line_moment(int k) { return k % 2 == 0 ? 2.0 / (k + 1) : 0; }

/// Integral of x^a y^b z^c over the reference element, in closed form.
double moment(ReferenceShape shape, int a, int b, int c) {
  switch (shape) {
    case ReferenceShape::hexahedron:
      return line_moment(a) * line_moment(b) * line_moment(c);
    case ReferenceShape::quadrilateral:
      return line_moment(a) * line_moment(b);
    case ReferenceShape::triangle:
      return factorial(a) * factorial(b) / factorial(a + b + 2);
    case ReferenceShape::prism:
      return factorial(a) * factorial(b) / factorial(a + b + 2) * line_moment(c);
    case ReferenceShape::tetrahedron:
      return factorial(a) * factorial(b) * factorial(c) / factorial(a + b + c + 3);
    case ReferenceShape::pyramid:
      return line_moment(a) * line_moment(b) * factorial(a + b + 2) * factorial(c) /
             factorial(a + b + c + 3);
  }
  return 0;
}

}  // namespace

TEST_CASE("each node of an element stands on its own place, the corners first") {
  for (const ElementKind kind : element_kinds()) {
    const auto nodes = reference_nodes(kind);
    CHECK(std::set(nodes.begin(), nodes.end()).size() == nodes.size());
    CHECK(corners_per_element(kind) <= nodes.size());
    CHECK((corners_per_element(kind) == nodes.size()) == (order_of(kind) == 1));
  }
}

TEST_CASE("the sides of an element close it, and their normals point outwards") {
  for (const ElementKind kind : element_kinds()) {
    const Eigen::Matrix3Xd nodes = node_points(kind);
    // Divergence theorem: int x . n dA / 3 is the volume, and int n dA vanishes.
    double volume = 0;
    Eigen::Vector3d closure = Eigen::Vector3d::Zero();
    for (const ReferenceFacet& side : facets_of(kind)) {
      CHECK(dimension(side.kind) == 2);
      REQUIRE(side.nodes.size() == nodes_per_element(side.kind));
      Eigen::Matrix3Xd x(3, static_cast<Eigen::Index>(side.nodes.size()));
      for (std::size_t i = 0; i < side.nodes.size(); ++i) {
        x.col(static_cast<Eigen::Index>(i)) = nodes.col(static_cast<Eigen::Index>(side.nodes[i]));
      }
      const Quadrature rule = gauss_rule(side.kind, 3);
      const ShapeTable table = tabulate(side.kind, rule.points);
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        const Eigen::Vector3d along_xi = x * table.derivatives[0].col(q);
        const Eigen::Vector3d along_eta = x * table.derivatives[1].col(q);
        const Eigen::Vector3d normal = rule.weights[q] * along_xi.cross(along_eta);
        volume += normal.dot(x * table.values.col(q)) / 3;
        closure += normal;
      }
    }
    CHECK(closure.norm() < kRounding);
    if (dimension(kind) == 3) CHECK(std::abs(volume - moment(shape_of(kind), 0, 0, 0)) < kRounding);
    CHECK(facets_of(kind).empty() == (dimension(kind) == 2));
  }
}

TEST_CASE("kinds are found by their names and unknown names are refused with the known ones") {
  for (const ElementKind kind : element_kinds()) {
    CHECK(element_kind_from(name_of(kind)) == kind);
  }
  CHECK_THROWS_AS(element_kind_from("hex26"), InputError);
  CHECK_THROWS_WITH(element_kind_from("hex26"), Catch::Contains("hex8, hex20, hex27"));
}

TEST_CASE("a shape function is one at its node and zero at the others") {
  for (const ElementKind kind : element_kinds()) {
    const ShapeTable table = tabulate(kind, node_points(kind));
    CHECK((table.values - Eigen::MatrixXd::Identity(table.values.rows(), table.values.cols()))
              .cwiseAbs()
              .maxCoeff() == 0);
  }
}

TEST_CASE("shape functions sum to one, their derivatives to zero") {
  for (const ElementKind kind : element_kinds()) {
    const ShapeTable table = tabulate(kind, scattered_points(kind));
    CHECK((table.values.colwise().sum().array() - 1).abs().maxCoeff() < kRounding);
    for (const Eigen::MatrixXd& derivative : table.derivatives) {
      CHECK(derivative.colwise().sum().cwiseAbs().maxCoeff() < kRounding);
    }
  }
}

TEST_CASE("shape functions interpolate the polynomials of their element") {
  for (const ElementKind kind : element_kinds()) {
    const Eigen::Matrix3Xd nodes = node_points(kind);
    const Eigen::Matrix3Xd points = scattered_points(kind);
    const ShapeTable table = tabulate(kind, points);
    const bool tensor = kind == ElementKind::hex27 || kind == ElementKind::quad9;
    for (int a = 0; a <= 2; ++a) {
      for (int b = 0; b <= 2; ++b) {
        for (int c = 0; c <= (dimension(kind) == 3 ? 2 : 0); ++c) {
          const auto monomial = [&](const Eigen::Matrix3Xd& x) -> Eigen::VectorXd {
            return x.row(0).array().pow(a) * x.row(1).array().pow(b) * x.row(2).array().pow(c);
          };
          if (!tensor && a + b + c > order_of(kind)) continue;
          CHECK((table.values.transpose() * monomial(nodes) - monomial(points)).norm() < kRounding);
        }
      }
    }
  }
}

TEST_CASE("derivatives agree with central differences of the values") {
  // Central differences of quadratics are exact; only rounding over the step remains. Those of the
  // pyramid's rational functions have an error of the square of the step.
  constexpr double kStep = 1e-3;
  constexpr double kDifferenceRounding = 1e-12;
  constexpr double kDifferenceError = 3 * kStep * kStep;
  for (const ElementKind kind : element_kinds()) {
    const bool exact = shape_of(kind) != ReferenceShape::pyramid;
    const Eigen::Matrix3Xd points = scattered_points(kind);
    const ShapeTable table = tabulate(kind, points);
    for (int d = 0; d < 3; ++d) {
      Eigen::Matrix3Xd ahead = points;
      Eigen::Matrix3Xd behind = points;
      ahead.row(d).array() += kStep;
      behind.row(d).array() -= kStep;
      const Eigen::MatrixXd difference =
          (tabulate(kind, ahead).values - tabulate(kind, behind).values) / (2 * kStep);
      CHECK((difference - table.derivatives[static_cast<std::size_t>(d)]).cwiseAbs().maxCoeff() <
            (exact ? kDifferenceRounding : kDifferenceError));
    }
  }
}

TEST_CASE("a rule integrates what its strength promises, with positive weights") {
  for (const ElementKind kind : element_kinds()) {
    const ReferenceShape shape = shape_of(kind);
    const bool simplex = shape == ReferenceShape::triangle || shape == ReferenceShape::tetrahedron;
    for (int n = 1; n <= (shape == ReferenceShape::tetrahedron ? 3 : 4); ++n) {
      const Quadrature rule = gauss_rule(kind, n);
      CHECK(rule.weights.minCoeff() > 0);
      const int line_degree = 2 * n - 1;
      const int simplex_degree = n == 1 ? 1 : n == 2 ? 2 : n == 3 ? 5 : 6;
      for (int a = 0; a <= line_degree; ++a) {
        for (int b = 0; b <= line_degree; ++b) {
          for (int c = 0; c <= (dimension(kind) == 3 ? line_degree : 0); ++c) {
            if (simplex && a + b + c > simplex_degree) continue;
            if (shape == ReferenceShape::prism && a + b > simplex_degree) continue;
            if (shape == ReferenceShape::pyramid && a + b + c > line_degree) continue;
            const double found =
                (rule.points.row(0).array().pow(a) * rule.points.row(1).array().pow(b) *
                 rule.points.row(2).array().pow(c) * rule.weights.transpose().array())
                    .sum();
            CHECK(std::abs(found - moment(shape, a, b, c)) < kRounding);
          }
        }
      }
    }
  }
}

TEST_CASE("a rule that does not exist is refused") {
  CHECK_THROWS_AS(gauss_rule(ElementKind::hex27, 0), InputError);
  CHECK_THROWS_AS(gauss_rule(ElementKind::hex27, 5), InputError);
  CHECK_THROWS_AS(gauss_rule(ElementKind::tet10, 4), InputError);
}

}  // namespace flexneck::mesher
