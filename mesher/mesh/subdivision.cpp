// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/subdivision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/LU>

#include "mesher/mesh/shape_functions.h"

namespace flexneck::mesher {
namespace {

/// A child of a reference element: the image of a shape's reference element under x -> origin +
/// linear x.
struct Piece {
  ReferenceShape shape;
  Eigen::Vector3d origin;
  Eigen::Matrix3d linear;
};

using Points = std::vector<Eigen::Vector3d>;

/// The map of the reference tetrahedron onto the one with these corners, reordered to a positive
/// volume.
Piece onto_tetrahedron(Points corners) {
  const auto edges = [&] {
    Eigen::Matrix3d matrix;
    for (int k = 0; k < 3; ++k)
      matrix.col(k) = corners[static_cast<std::size_t>(k) + 1] - corners[0];
    return matrix;
  };
  if (edges().determinant() < 0) std::swap(corners[2], corners[3]);
  return {ReferenceShape::tetrahedron, corners[0], edges()};
}

std::vector<Piece> pieces_of_tetrahedron() {
  const Points corner = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto middle = [&](std::size_t a, std::size_t b) -> Eigen::Vector3d {
    return (corner[a] + corner[b]) / 2;
  };
  std::vector<Piece> pieces;
  for (const Eigen::Vector3d& c : corner)
    pieces.push_back({ReferenceShape::tetrahedron, c / 2, Eigen::Matrix3d::Identity() / 2});
  // The remaining octahedron, divided along the diagonal between the midpoints of edges 02 and 13.
  const Eigen::Vector3d one = middle(0, 2);
  const Eigen::Vector3d other = middle(1, 3);
  const Points ring = {middle(0, 1), middle(0, 3), middle(2, 3), middle(1, 2)};
  for (std::size_t k = 0; k < ring.size(); ++k) {
    pieces.push_back(onto_tetrahedron({one, other, ring[k], ring[(k + 1) % ring.size()]}));
  }
  return pieces;
}

/// Triangles in the plane zeta = 0: three at the corners, and the middle one rotated by half a
/// turn.
std::vector<Piece> pieces_of_triangle() {
  const ReferenceShape shape = ReferenceShape::triangle;
  const Eigen::Matrix3d half = Eigen::Vector3d(0.5, 0.5, 1).asDiagonal();
  const Eigen::Matrix3d turned = Eigen::Vector3d(-0.5, -0.5, 1).asDiagonal();
  return {{shape, {0, 0, 0}, half},
          {shape, {0.5, 0, 0}, half},
          {shape, {0, 0.5, 0}, half},
          {shape, {0.5, 0.5, 0}, turned}};
}

/// Five pyramids at the corners, one upside down below the topmost, and four tetrahedra.
std::vector<Piece> pieces_of_pyramid() {
  const Eigen::Matrix3d half = Eigen::Matrix3d::Identity() / 2;
  const Eigen::Matrix3d upside_down = Eigen::Vector3d(0.5, -0.5, -0.5).asDiagonal();
  const ReferenceShape shape = ReferenceShape::pyramid;
  std::vector<Piece> pieces = {{shape, {0, 0, 0.5}, half}, {shape, {0, 0, 0.5}, upside_down}};
  const Points corners = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
  const Eigen::Vector3d up(0, 0, 0.5);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector3d& a = corners[k];
    const Eigen::Vector3d& b = corners[(k + 1) % corners.size()];
    pieces.push_back({shape, a, half});
    pieces.push_back(onto_tetrahedron({Eigen::Vector3d::Zero(), a + b, a + up, b + up}));
  }
  return pieces;
}

std::vector<Piece> pieces_of(ReferenceShape shape) {
  std::vector<Piece> pieces;
  switch (shape) {
    case ReferenceShape::hexahedron:
      for (const double z : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) {
          for (const double x : {-0.5, 0.5}) {
            pieces.push_back({shape, {x, y, z}, Eigen::Matrix3d::Identity() / 2});
          }
        }
      }
      break;
    case ReferenceShape::quadrilateral:
      for (const double y : {-0.5, 0.5}) {
        for (const double x : {-0.5, 0.5}) {
          pieces.push_back({shape, {x, y, 0}, Eigen::Matrix3d::Identity() / 2});
        }
      }
      break;
    case ReferenceShape::prism:
      for (const double z : {-0.5, 0.5}) {
        for (Piece piece : pieces_of_triangle()) {
          piece.shape = shape;
          piece.origin[2] = z;
          piece.linear(2, 2) = 0.5;
          pieces.push_back(piece);
        }
      }
      break;
    case ReferenceShape::tetrahedron:
      return pieces_of_tetrahedron();
    case ReferenceShape::pyramid:
      return pieces_of_pyramid();
    case ReferenceShape::triangle:
      return pieces_of_triangle();
  }
  return pieces;
}

/// The kind of a child: that of the parent or, if the shape differs, one of the same order. All
/// tetrahedra of an order have as many nodes on a facet as the pyramids that they are cut from.
ElementKind kind_of_piece(ElementKind whole, ReferenceShape shape) {
  if (shape == shape_of(whole)) return whole;
  const auto kinds = element_kinds();
  return *std::find_if(kinds.begin(), kinds.end(), [&](ElementKind kind) {
    return shape_of(kind) == shape && order_of(kind) == order_of(whole);
  });
}

/// The quadratic kind of most nodes in place of a linear one; others stay.
ElementKind raised(ElementKind whole) {
  if (order_of(whole) > 1) return whole;
  const auto nodes_of = [&](ElementKind kind) {
    return shape_of(kind) == shape_of(whole) ? nodes_per_element(kind) : 0;
  };
  const auto kinds = element_kinds();
  return *std::max_element(kinds.begin(), kinds.end(),
                           [&](ElementKind a, ElementKind b) { return nodes_of(a) < nodes_of(b); });
}

}  // namespace

Subdivision::Subdivision(ElementKind whole, Finer how) : kind(whole) {
  constexpr double kNothing = 1e-12;
  std::map<std::array<double, 3>, std::size_t> known;  // coordinates are dyadic, so exact
  Points points;
  const Piece all{shape_of(kind), Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()};
  for (const Piece& piece : how == Finer::cut ? pieces_of(all.shape) : std::vector{all}) {
    const ElementKind kind_here =
        how == Finer::cut ? kind_of_piece(kind, piece.shape) : raised(kind);
    for (const auto& node : reference_nodes(kind_here)) {
      const Eigen::Vector3d x = piece.origin + piece.linear * Eigen::Vector3d(node.data());
      const auto [place, is_new] = known.try_emplace({x[0], x[1], x[2]}, points.size());
      if (is_new) points.push_back(x);
      pieces[kind_here].push_back(place->second);
    }
  }
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    columns.col(static_cast<Eigen::Index>(k)) = points[k];
  const Eigen::MatrixXd values = tabulate(kind, columns).values;
  for (const auto& column : values.colwise()) {
    std::vector<NodeWeight>& weights = positions.emplace_back();
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      if (std::abs(column[i]) > kNothing)
        weights.push_back({static_cast<std::int32_t>(i), column[i]});
    }
  }
}

}  // namespace flexneck::mesher
