// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <set>

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
  points.row(0) << 0.31, -0.87, 0.05, 0.99;
  points.row(1) << -0.52, 0.13, 0.77, -0.98;
  points.row(2) << 0.68, 0.41, -0.93, 0.22;
  if (dimension(kind) == 2) points.row(2).setZero();
  return points;
}

/// int_-1^1 x^k dx
double line_moment(int k) { return k % 2 == 0 ? 2.0 / (k + 1) : 0; }

}  // namespace

TEST_CASE("each node of an element stands on its own place: corners, edges, faces, centre") {
  for (const ElementKind kind : {ElementKind::hex27, ElementKind::quad9}) {
    const auto nodes = reference_nodes(kind);
    CHECK(nodes.size() == static_cast<std::size_t>(std::pow(3, dimension(kind))));
    CHECK(std::set(nodes.begin(), nodes.end()).size() == nodes.size());
    int zeros_before = 0;
    for (const auto& node : nodes) {
      int zeros = 0;
      for (int d = 0; d < dimension(kind); ++d) zeros += node[static_cast<std::size_t>(d)] == 0;
      CHECK(zeros >= zeros_before);
      zeros_before = zeros;
    }
  }
}

TEST_CASE("kinds are found by their names and unknown names are refused with the known ones") {
  for (const ElementKind kind : {ElementKind::hex27, ElementKind::quad9}) {
    CHECK(element_kind_from(name_of(kind)) == kind);
  }
  CHECK_THROWS_AS(element_kind_from("hex26"), InputError);
  CHECK_THROWS_WITH(element_kind_from("hex26"), Catch::Contains("hex27, quad9"));
}

TEST_CASE("a shape function is one at its node and zero at the others") {
  for (const ElementKind kind : {ElementKind::hex27, ElementKind::quad9}) {
    const ShapeTable table = tabulate(kind, node_points(kind));
    CHECK((table.values - Eigen::MatrixXd::Identity(table.values.rows(), table.values.cols()))
              .cwiseAbs()
              .maxCoeff() == 0);
  }
}

TEST_CASE("shape functions sum to one, their derivatives to zero") {
  for (const ElementKind kind : {ElementKind::hex27, ElementKind::quad9}) {
    const ShapeTable table = tabulate(kind, scattered_points(kind));
    CHECK((table.values.colwise().sum().array() - 1).abs().maxCoeff() < kRounding);
    for (const Eigen::MatrixXd& derivative : table.derivatives) {
      CHECK(derivative.colwise().sum().cwiseAbs().maxCoeff() < kRounding);
    }
  }
}

TEST_CASE("shape functions interpolate every triquadratic monomial") {
  for (const ElementKind kind : {ElementKind::hex27, ElementKind::quad9}) {
    const Eigen::Matrix3Xd nodes = node_points(kind);
    const Eigen::Matrix3Xd points = scattered_points(kind);
    const ShapeTable table = tabulate(kind, points);
    for (int a = 0; a <= 2; ++a) {
      for (int b = 0; b <= 2; ++b) {
        for (int c = 0; c <= (dimension(kind) == 3 ? 2 : 0); ++c) {
          const auto monomial = [&](const Eigen::Matrix3Xd& x) -> Eigen::VectorXd {
            return x.row(0).array().pow(a) * x.row(1).array().pow(b) * x.row(2).array().pow(c);
          };
          CHECK((table.values.transpose() * monomial(nodes) - monomial(points)).norm() < kRounding);
        }
      }
    }
  }
}

TEST_CASE("derivatives agree with central differences of the values") {
  // Central differences of quadratics are exact; only rounding over the step remains.
  constexpr double kStep = 1e-3;
  constexpr double kDifferenceRounding = 1e-12;
  for (const ElementKind kind : {ElementKind::hex27, ElementKind::quad9}) {
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
            kDifferenceRounding);
    }
  }
}

TEST_CASE("a Gauss rule with n points is exact to degree 2n - 1 and not beyond") {
  for (const ElementKind kind : {ElementKind::hex27, ElementKind::quad9}) {
    for (int n = 1; n <= 4; ++n) {
      const Quadrature rule = gauss_rule(kind, n);
      const int top = 2 * n - 1;
      const bool volume = dimension(kind) == 3;
      for (int a = 0; a <= top; ++a) {
        for (int b = 0; b <= top; ++b) {
          for (int c = 0; c <= (volume ? top : 0); ++c) {
            const double expected = line_moment(a) * line_moment(b) * (volume ? line_moment(c) : 1);
            const double found =
                (rule.points.row(0).array().pow(a) * rule.points.row(1).array().pow(b) *
                 rule.points.row(2).array().pow(c) * rule.weights.transpose().array())
                    .sum();
            CHECK(std::abs(found - expected) < kRounding);
          }
        }
      }
      const double beyond =
          (rule.points.row(1).array().pow(2 * n) * rule.weights.transpose().array()).sum();
      CHECK(std::abs(beyond - line_moment(2 * n) * (volume ? 4 : 2)) > 1e-3);
    }
  }
}

TEST_CASE("a Gauss rule outside one to four points is refused") {
  CHECK_THROWS_AS(gauss_rule(ElementKind::hex27, 0), InputError);
  CHECK_THROWS_AS(gauss_rule(ElementKind::hex27, 5), InputError);
}

}  // namespace flexneck::mesher
