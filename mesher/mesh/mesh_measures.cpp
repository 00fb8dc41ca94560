// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/mesh_measures.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Dense>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/positions.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::mesher {
namespace {

/// Scaled Jacobian below which it is only rounding: the element has no usable inverse map.
constexpr double kDegenerate = 1e-6;

Eigen::Matrix3Xd node_points(ElementKind kind) {
  const auto nodes = reference_nodes(kind);
  Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    points.col(static_cast<Eigen::Index>(n)) = Eigen::Vector3d(nodes[n].data());
  }
  return points;
}

/// Jacobian with columns dx/dxi, dx/deta, dx/dzeta at point q.
Eigen::Matrix3d jacobian_at(const Eigen::Matrix3Xd& x, const ShapeTable& table, Eigen::Index q) {
  Eigen::Matrix3d jacobian;
  for (Eigen::Index d = 0; d < 3; ++d) {
    jacobian.col(d) = x * table.derivatives[static_cast<std::size_t>(d)].col(q);
  }
  return jacobian;
}

/// Directions of the edges that meet in the corners of a reference element, and the factor that
/// makes the scaled Jacobian of the ideal element one. The corners of a hexahedron differ in signs
/// only.
struct CornerEdges {
  std::vector<Eigen::Matrix3d> triads;
  double ideal;
};

CornerEdges corner_edges(ElementKind kind) {
  const auto triad = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c) -> Eigen::Matrix3d {
    return (Eigen::Matrix3d() << a, b, c).finished();
  };
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  switch (shape_of(kind)) {
    case ReferenceShape::prism:
      return {{triad(x, y, z), triad(y - x, -x, z), triad(-y, x - y, z)}, 2 / std::sqrt(3.0)};
    case ReferenceShape::tetrahedron:
      return {{triad(x, y, z), triad(y - x, -x, z - x), triad(-y, x - y, z - y),
               triad(x - z, -z, y - z)},
              std::sqrt(2.0)};
    case ReferenceShape::pyramid:
      return {{triad(x, y, x + y + z), triad(x, y, y + z - x), triad(x, y, z - x - y),
               triad(x, y, x + z - y)},
              std::sqrt(2.0)};
    default:
      return {{Eigen::Matrix3d::Identity()}, 1};
  }
}

/// Smallest scaled determinant. NaN positions give NaN, which every comparison with a bound
/// refuses.
double scaled_determinant(const Eigen::Matrix3d& jacobian, const CornerEdges& edges) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix3d& triad : edges.triads) {
    const Eigen::Matrix3d directions = jacobian * triad;
    const double lengths = directions.colwise().norm().prod();
    smallest = std::min(smallest, lengths > 0 ? directions.determinant() / lengths : 0);
  }
  return edges.ideal * smallest;
}

double smallest_scaled(const Eigen::Matrix3Xd& x, const ShapeTable& table,
                       const CornerEdges& edges) {
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index q = 0; q < table.values.cols(); ++q) {
    smallest = std::min(smallest, scaled_determinant(jacobian_at(x, table, q), edges));
  }
  return smallest;
}

std::span<const std::int32_t> nodes_of(std::span<const std::int32_t> all, ElementKind kind,
                                       std::size_t element) {
  const std::size_t n = nodes_per_element(kind);
  return all.subspan(element * n, n);
}

/// Pairs of local corners that an edge joins.
std::vector<std::pair<Eigen::Index, Eigen::Index>> edges_of(ElementKind kind) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> edges;
  for (const ReferenceFacet& side : facets_of(kind)) {
    const std::size_t corners = corners_per_element(side.kind);
    for (std::size_t c = 0; c < corners; ++c) {
      const std::size_t a = side.nodes[c];
      const std::size_t b = side.nodes[(c + 1) % corners];
      // Both facets at an edge follow it, in opposite directions: take one.
      if (a < b) edges.emplace_back(a, b);
    }
  }
  return edges;
}

double aspect_ratio(const Eigen::Matrix3Xd& x,
                    const std::vector<std::pair<Eigen::Index, Eigen::Index>>& edges) {
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0;
  for (const auto& [a, b] : edges) {
    const double length = (x.col(a) - x.col(b)).norm();
    shortest = std::min(shortest, length);
    longest = std::max(longest, length);
  }
  return longest / shortest;
}

}  // namespace

BlockMeasure measure(const Mesh& mesh, const ElementBlock& block) {
  // The determinant of a triquadratic map has degree 5 in each direction, that of a quadratic map
  // on the simplex the total degree 3: a rule of strength three is exact.
  const Quadrature rule = gauss_rule(block.kind, 3);
  const ShapeTable at_rule = tabulate(block.kind, rule.points);
  const ShapeTable at_nodes = tabulate(block.kind, node_points(block.kind));
  const CornerEdges corners = corner_edges(block.kind);
  const auto edges = edges_of(block.kind);

  BlockMeasure result;
  result.smallest_scaled_jacobian = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < block.size(); ++e) {
    const Eigen::Matrix3Xd x = positions_of(mesh, nodes_of(block.nodes, block.kind, e));
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      result.volume_m3 += rule.weights[q] * jacobian_at(x, at_rule, q).determinant();
    }
    const double scaled =
        std::min(smallest_scaled(x, at_rule, corners), smallest_scaled(x, at_nodes, corners));
    result.max_aspect_ratio = std::max(result.max_aspect_ratio, aspect_ratio(x, edges));
    if (scaled < result.smallest_scaled_jacobian) {
      result.smallest_scaled_jacobian = scaled;
      result.worst_element = e;
    }
  }
  return result;
}

std::vector<double> scaled_jacobians(const Mesh& mesh, const ElementBlock& block) {
  const ShapeTable at_rule = tabulate(block.kind, gauss_rule(block.kind, 3).points);
  const ShapeTable at_nodes = tabulate(block.kind, node_points(block.kind));
  const CornerEdges corners = corner_edges(block.kind);
  std::vector<double> scaled(block.size());
  for (std::size_t e = 0; e < scaled.size(); ++e) {
    const Eigen::Matrix3Xd x = positions_of(mesh, nodes_of(block.nodes, block.kind, e));
    scaled[e] =
        std::min(smallest_scaled(x, at_rule, corners), smallest_scaled(x, at_nodes, corners));
  }
  return scaled;
}

double area_m2(const Mesh& mesh, const FaceBlock& faces) {
  // The length of the normal is not a polynomial on a curved face: use the finest rule available.
  const Quadrature rule = gauss_rule(faces.kind, 4);
  const ShapeTable table = tabulate(faces.kind, rule.points);
  double area = 0;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Eigen::Matrix3Xd x = positions_of(mesh, nodes_of(faces.nodes, faces.kind, f));
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Vector3d along_xi = x * table.derivatives[0].col(q);
      const Eigen::Vector3d along_eta = x * table.derivatives[1].col(q);
      area += rule.weights[q] * along_xi.cross(along_eta).norm();
    }
  }
  return area;
}

double area_m2(const Mesh& mesh, const FaceSet& faces) {
  double area = 0;
  for (const FaceBlock& block : faces.blocks) area += area_m2(mesh, block);
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
    throw ComputationError("mesh: part '" + block.part + "': element " +
                           std::to_string(measured.worst_element) + " near (" +
                           rounded_texts({centre.data(), 3}, 4) +
                           ") m is inverted or degenerate (scaled Jacobian " +
                           rounded_text(measured.smallest_scaled_jacobian, 3) +
                           "); try other dimensions or divisions");
  }
}

}  // namespace flexneck::mesher
