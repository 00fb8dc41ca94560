// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/drawing/outer_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "mesher/mesh/boundary.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/positions.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::mesher {
namespace {

/// An evenly divided face: points of its reference element, triangles between them, and the chain
/// of points along each of its edges.
struct Division {
  Eigen::Matrix3Xd points;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::vector<std::int32_t>> edges;
};

Division divide_quadrilateral(int n) {
  Division division{Eigen::Matrix3Xd::Zero(3, (n + 1) * (n + 1)), {}, {{}, {}, {}, {}}};
  const auto point = [n](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      division.points.col(point(i, j)) << 2.0 * i / n - 1, 2.0 * j / n - 1, 0;
      if (i == n || j == n) continue;
      division.triangles.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1)});
      division.triangles.push_back({point(i, j), point(i + 1, j + 1), point(i, j + 1)});
    }
  }
  for (int i = 0; i <= n; ++i) {
    division.edges[0].push_back(point(i, 0));
    division.edges[1].push_back(point(n, i));
    division.edges[2].push_back(point(n - i, n));
    division.edges[3].push_back(point(0, n - i));
  }
  return division;
}

Division divide_triangle(int n) {
  Division division{Eigen::Matrix3Xd::Zero(3, (n + 1) * (n + 2) / 2), {}, {{}, {}, {}}};
  const auto point = [n](int i, int j) { return j * (n + 1) - j * (j - 1) / 2 + i; };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n - j; ++i) {
      division.points.col(point(i, j)) << static_cast<double>(i) / n, static_cast<double>(j) / n, 0;
      if (i + j == n) continue;
      division.triangles.push_back({point(i, j), point(i + 1, j), point(i, j + 1)});
      if (i + j + 1 == n) continue;
      division.triangles.push_back({point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
    }
  }
  for (int i = 0; i <= n; ++i) {
    division.edges[0].push_back(point(i, 0));
    division.edges[1].push_back(point(n - i, i));
    division.edges[2].push_back(point(0, n - i));
  }
  return division;
}

/// A face kind with its shape functions tabulated at the points of its division.
struct DividedKind {
  Division division;
  ShapeTable table;

  DividedKind(ElementKind kind, int n)
      : division(shape_of(kind) == ReferenceShape::triangle ? divide_triangle(n)
                                                            : divide_quadrilateral(n)),
        table(tabulate(kind, division.points)) {}
};

using Triplets = std::vector<Eigen::Triplet<double>>;

void append(const Eigen::MatrixXd& values, const Facet& side, std::int32_t first_vertex,
            Triplets& triplets) {
  for (Eigen::Index v = 0; v < values.cols(); ++v) {
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      triplets.emplace_back(first_vertex + static_cast<std::int32_t>(v),
                            side.nodes[static_cast<std::size_t>(i)], values(i, v));
    }
  }
}

std::vector<std::int32_t> shifted(std::vector<std::int32_t> chain, std::int32_t by) {
  for (std::int32_t& vertex : chain) vertex += by;
  return chain;
}

/// The first face seen at an edge between two corner nodes.
struct EdgeOwner {
  std::size_t block;
  Eigen::Vector3d normal;
};

Eigen::Vector3d centre_normal(const Mesh& mesh, const Facet& side) {
  const bool triangle = shape_of(side.kind) == ReferenceShape::triangle;
  const Eigen::Vector3d centre =
      triangle ? Eigen::Vector3d(1.0 / 3, 1.0 / 3, 0) : Eigen::Vector3d(0, 0, 0);
  const ShapeTable table = tabulate(side.kind, centre);
  const Eigen::Matrix3Xd x = positions_of(mesh, side.nodes);
  const Eigen::Vector3d along_xi = x * table.derivatives[0];
  const Eigen::Vector3d along_eta = x * table.derivatives[1];
  return along_xi.cross(along_eta).normalized();
}

/// Adds the edges of a face that lie between parts, or between faces that meet at an angle.
class OutlineFinder {
 public:
  /// Faces whose normals differ by more than 40 degrees meet at a visible edge.
  static constexpr double kSharpCosine = 0.77;

  void add(const Mesh& mesh, const Facet& side,
           const std::vector<std::vector<std::int32_t>>& chains, Surface& surface) {
    const Eigen::Vector3d normal = centre_normal(mesh, side);
    for (std::size_t e = 0; e < chains.size(); ++e) {
      const std::int32_t a = side.nodes[e];
      const std::int32_t b = side.nodes[(e + 1) % chains.size()];
      const auto [owner, is_new] =
          owners_.try_emplace(std::minmax(a, b), EdgeOwner{side.block, normal});
      if (is_new) continue;
      if (owner->second.block != side.block || owner->second.normal.dot(normal) < kSharpCosine) {
        surface.outlines.push_back(chains[e]);
      }
    }
  }

 private:
  std::map<std::pair<std::int32_t, std::int32_t>, EdgeOwner> owners_;
};

/// Finest division of a facet that gives at most `most` triangles in all.
int division_for(std::size_t sides, std::size_t most) {
  int n = 6;
  while (n > 1 && sides * 2 * static_cast<std::size_t>(n) * static_cast<std::size_t>(n) > most) --n;
  return n;
}

}  // namespace

Surface surface_of(const Mesh& mesh, std::size_t max_triangles) {
  const std::vector<Facet> sides = boundary_facets(mesh);
  const int n = division_for(sides.size(), max_triangles);
  std::map<ElementKind, DividedKind> kinds;
  Surface surface;
  OutlineFinder outlines;
  Triplets value, along_xi, along_eta;
  std::int32_t vertices = 0;
  for (const Facet& side : sides) {
    const DividedKind& kind = kinds.try_emplace(side.kind, side.kind, n).first->second;
    append(kind.table.values, side, vertices, value);
    append(kind.table.derivatives[0], side, vertices, along_xi);
    append(kind.table.derivatives[1], side, vertices, along_eta);
    for (const auto& t : kind.division.triangles) {
      surface.triangles.push_back({t[0] + vertices, t[1] + vertices, t[2] + vertices});
    }
    std::vector<std::vector<std::int32_t>> chains;
    for (const auto& edge : kind.division.edges) chains.push_back(shifted(edge, vertices));
    outlines.add(mesh, side, chains, surface);
    surface.edges.insert(surface.edges.end(), chains.begin(), chains.end());
    const Eigen::Index count = kind.division.points.cols();
    surface.block_of_vertex.insert(surface.block_of_vertex.end(), static_cast<std::size_t>(count),
                                   side.block);
    vertices += static_cast<std::int32_t>(count);
  }
  for (const auto& [matrix, triplets] :
       {std::pair{&surface.value, &value}, std::pair{&surface.along_xi, &along_xi},
        std::pair{&surface.along_eta, &along_eta}}) {
    matrix->resize(vertices, static_cast<Eigen::Index>(mesh.nodes.size()));
    matrix->setFromTriplets(triplets->begin(), triplets->end());
  }
  return surface;
}

}  // namespace flexneck::mesher
