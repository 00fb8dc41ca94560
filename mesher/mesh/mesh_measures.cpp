// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/mesh_measures.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include <Eigen/Dense>

#include "geometry/foundation/error.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::mesher {
namespace {

/// Below this a scaled Jacobian is rounding: the element has no usable inverse map.
constexpr double kDegenerate = 1e-6;

Eigen::Matrix3Xd node_points(ElementKind kind) {
  const auto nodes = reference_nodes(kind);
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    points.col(static_cast<Eigen::Index>(n)) = Eigen::Vector3d(nodes[n].data());
  }
  return points;
}

/// Columns dx/dxi, dx/deta, dx/dzeta at point q.
Eigen::Matrix3d jacobian_at(const Eigen::Matrix3Xd& x, const ShapeTable& table, Eigen::Index q) {
  Eigen::Matrix3d jacobian;
  for (Eigen::Index d = 0; d < 3; ++d) {
    jacobian.col(d) = x * table.derivatives[static_cast<std::size_t>(d)].col(q);
  }
  return jacobian;
}

/// NaN positions give NaN, which every comparison with a bound refuses.
double scaled_determinant(const Eigen::Matrix3d& jacobian) {
  const double lengths = jacobian.colwise().norm().prod();
  return lengths > 0 ? jacobian.determinant() / lengths : 0;
}

double smallest_scaled(const Eigen::Matrix3Xd& x, const ShapeTable& table) {
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index q = 0; q < table.values.cols(); ++q) {
    smallest = std::min(smallest, scaled_determinant(jacobian_at(x, table, q)));
  }
  return smallest;
}

std::span<const std::int32_t> nodes_of(std::span<const std::int32_t> all, ElementKind kind,
                                       std::size_t element) {
  const std::size_t n = nodes_per_element(kind);
  return all.subspan(element * n, n);
}

}  // namespace

Eigen::Matrix3Xd positions_of(const Mesh& mesh, std::span<const std::int32_t> nodes) {
  Eigen::Matrix3Xd x(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto& position = mesh.nodes[static_cast<std::size_t>(nodes[n])];
    x.col(static_cast<Eigen::Index>(n)) = Eigen::Vector3d(position.data());
  }
  return x;
}

BlockMeasure measure(const Mesh& mesh, const ElementBlock& block) {
  // The determinant of a triquadratic map has degree 5 in each direction: three points are exact.
  const Quadrature rule = gauss_rule(block.kind, 3);
  const ShapeTable at_rule = tabulate(block.kind, rule.points);
  const ShapeTable at_nodes = tabulate(block.kind, node_points(block.kind));

  BlockMeasure result;
  result.smallest_scaled_jacobian = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < block.size(); ++e) {
    const Eigen::Matrix3Xd x = positions_of(mesh, nodes_of(block.nodes, block.kind, e));
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      result.volume_m3 += rule.weights[q] * jacobian_at(x, at_rule, q).determinant();
    }
    const double scaled = std::min(smallest_scaled(x, at_rule), smallest_scaled(x, at_nodes));
    if (scaled < result.smallest_scaled_jacobian) {
      result.smallest_scaled_jacobian = scaled;
      result.worst_element = e;
    }
  }
  return result;
}

double area_m2(const Mesh& mesh, const FaceSet& faces) {
  // The length of the normal is no polynomial on a curved face: use the finest rule there is.
  const Quadrature rule = gauss_rule(faces.kind, 4);
  const ShapeTable table = tabulate(faces.kind, rule.points);
  const std::size_t count = faces.nodes.size() / nodes_per_element(faces.kind);
  double area = 0;
  for (std::size_t f = 0; f < count; ++f) {
    const Eigen::Matrix3Xd x = positions_of(mesh, nodes_of(faces.nodes, faces.kind, f));
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector3d along_xi = x * table.derivatives[0].col(q);
      const Eigen::Vector3d along_eta = x * table.derivatives[1].col(q);
      area += rule.weights[q] * along_xi.cross(along_eta).norm();
    }
  }
  return area;
}

void require_sound_elements(const Mesh& mesh) {
  for (const ElementBlock& block : mesh.blocks) {
    const BlockMeasure measured = measure(mesh, block);
    if (measured.smallest_scaled_jacobian > kDegenerate) continue;
    const Eigen::Vector3d centre =
        positions_of(mesh, nodes_of(block.nodes, block.kind, measured.worst_element))
            .rowwise()
            .mean();
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "element %zu round (%.4g, %.4g, %.4g) m is inverted or degenerate (scaled "
                  "Jacobian %.3g)",
                  measured.worst_element, centre.x(), centre.y(), centre.z(),
                  measured.smallest_scaled_jacobian);
    throw ComputationError("mesh: part '" + block.part + "': " + text.data() +
                           "; try other dimensions or divisions");
  }
}

}  // namespace flexneck::mesher
