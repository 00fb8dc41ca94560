// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/element_kind.h"

#include <algorithm>
#include <string>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

using Point = std::array<double, 3>;

// Nodes of the kinds with most nodes. Kinds with fewer have the first of them, in the same order.

constexpr std::array<Point, 27> kHexahedronNodes = {{
    // corners
    {-1, -1, -1},
    {1, -1, -1},
    {1, 1, -1},
    {-1, 1, -1},
    {-1, -1, 1},
    {1, -1, 1},
    {1, 1, 1},
    {-1, 1, 1},
    // edges
    {0, -1, -1},
    {-1, 0, -1},
    {-1, -1, 0},
    {1, 0, -1},
    {1, -1, 0},
    {0, 1, -1},
    {1, 1, 0},
    {-1, 1, 0},
    {0, -1, 1},
    {-1, 0, 1},
    {1, 0, 1},
    {0, 1, 1},
    // faces
    {0, 0, -1},
    {0, -1, 0},
    {-1, 0, 0},
    {1, 0, 0},
    {0, 1, 0},
    {0, 0, 1},
    // centre
    {0, 0, 0},
}};

constexpr std::array<Point, 18> kPrismNodes = {{
    // corners
    {0, 0, -1},
    {1, 0, -1},
    {0, 1, -1},
    {0, 0, 1},
    {1, 0, 1},
    {0, 1, 1},
    // edges
    {0.5, 0, -1},
    {0, 0.5, -1},
    {0, 0, 0},
    {0.5, 0.5, -1},
    {1, 0, 0},
    {0, 1, 0},
    {0.5, 0, 1},
    {0, 0.5, 1},
    {0.5, 0.5, 1},
    // quadrilateral faces
    {0.5, 0, 0},
    {0, 0.5, 0},
    {0.5, 0.5, 0},
}};

constexpr std::array<Point, 10> kTetrahedronNodes = {{
    // corners
    {0, 0, 0},
    {1, 0, 0},
    {0, 1, 0},
    {0, 0, 1},
    // edges
    {0.5, 0, 0},
    {0.5, 0.5, 0},
    {0, 0.5, 0},
    {0, 0, 0.5},
    {0, 0.5, 0.5},
    {0.5, 0, 0.5},
}};

constexpr std::array<Point, 9> kQuadrilateralNodes = {{
    // corners
    {-1, -1, 0},
    {1, -1, 0},
    {1, 1, 0},
    {-1, 1, 0},
    // edges
    {0, -1, 0},
    {1, 0, 0},
    {0, 1, 0},
    {-1, 0, 0},
    // centre
    {0, 0, 0},
}};

constexpr std::array<Point, 6> kTriangleNodes = {{
    // corners
    {0, 0, 0},
    {1, 0, 0},
    {0, 1, 0},
    // edges
    {0.5, 0, 0},
    {0.5, 0.5, 0},
    {0, 0.5, 0},
}};

/// All that is known of a kind: a new kind is one row here.
struct KindRecord {
  ElementKind kind;
  std::string_view name;
  ReferenceShape shape;
  int order;
  std::span<const Point> nodes;
};

constexpr std::array<KindRecord, 10> kKinds = {{
    {ElementKind::hex8, "hex8", ReferenceShape::hexahedron, 1,
     std::span(kHexahedronNodes).first(8)},
    {ElementKind::hex20, "hex20", ReferenceShape::hexahedron, 2,
     std::span(kHexahedronNodes).first(20)},
    {ElementKind::hex27, "hex27", ReferenceShape::hexahedron, 2, kHexahedronNodes},
    {ElementKind::prism15, "prism15", ReferenceShape::prism, 2, std::span(kPrismNodes).first(15)},
    {ElementKind::prism18, "prism18", ReferenceShape::prism, 2, kPrismNodes},
    {ElementKind::tet10, "tet10", ReferenceShape::tetrahedron, 2, kTetrahedronNodes},
    {ElementKind::quad4, "quad4", ReferenceShape::quadrilateral, 1,
     std::span(kQuadrilateralNodes).first(4)},
    {ElementKind::quad8, "quad8", ReferenceShape::quadrilateral, 2,
     std::span(kQuadrilateralNodes).first(8)},
    {ElementKind::quad9, "quad9", ReferenceShape::quadrilateral, 2, kQuadrilateralNodes},
    {ElementKind::tri6, "tri6", ReferenceShape::triangle, 2, kTriangleNodes},
}};

const KindRecord& record_of(ElementKind kind) { return kKinds.at(static_cast<std::size_t>(kind)); }

using Corners = std::vector<std::size_t>;

/// Corners of the sides, counter-clockwise from outside.
std::vector<Corners> facet_corners(ReferenceShape shape) {
  switch (shape) {
    case ReferenceShape::hexahedron:
      return {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};
    case ReferenceShape::prism:
      return {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
    case ReferenceShape::tetrahedron:
      return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    default:
      return {};
  }
}

/// The node in the middle of some others, if the kind has one there.
void append_middle(std::span<const Point> nodes, const Corners& of, Corners& side) {
  Point middle{};
  for (const std::size_t corner : of) {
    for (std::size_t d = 0; d < 3; ++d) {
      middle[d] += nodes[corner][d] / static_cast<double>(of.size());
    }
  }
  const auto found = std::find(nodes.begin(), nodes.end(), middle);
  if (found != nodes.end()) side.push_back(static_cast<std::size_t>(found - nodes.begin()));
}

ElementKind facet_kind(std::size_t corners, std::size_t nodes) {
  if (corners == 3) return ElementKind::tri6;
  return nodes == 4 ? ElementKind::quad4 : nodes == 8 ? ElementKind::quad8 : ElementKind::quad9;
}

std::vector<ReferenceFacet> make_facets(const KindRecord& record) {
  std::vector<ReferenceFacet> sides;
  for (const Corners& corners : facet_corners(record.shape)) {
    Corners side = corners;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      append_middle(record.nodes, {corners[c], corners[(c + 1) % corners.size()]}, side);
    }
    if (corners.size() == 4) append_middle(record.nodes, corners, side);
    sides.push_back({facet_kind(corners.size(), side.size()), side});
  }
  return sides;
}

}  // namespace

std::span<const ElementKind> element_kinds() {
  static constexpr auto kAll = [] {
    std::array<ElementKind, kKinds.size()> all{};
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = kKinds[k].kind;
    return all;
  }();
  return kAll;
}

std::string_view name_of(ElementKind kind) { return record_of(kind).name; }

ElementKind element_kind_from(std::string_view name) {
  std::string known;
  for (const KindRecord& record : kKinds) {
    if (record.name == name) return record.kind;
    known += (known.empty() ? "" : ", ") + std::string(record.name);
  }
  throw InputError("unknown element kind '" + std::string(name) + "', expected one of " + known);
}

ReferenceShape shape_of(ElementKind kind) { return record_of(kind).shape; }

std::span<const std::array<double, 3>> reference_nodes(ElementKind kind) {
  return record_of(kind).nodes;
}

std::size_t corners_per_element(ElementKind kind) {
  switch (shape_of(kind)) {
    case ReferenceShape::hexahedron:
      return 8;
    case ReferenceShape::prism:
      return 6;
    case ReferenceShape::triangle:
      return 3;
    default:
      return 4;
  }
}

int dimension(ElementKind kind) {
  const ReferenceShape shape = shape_of(kind);
  return shape == ReferenceShape::quadrilateral || shape == ReferenceShape::triangle ? 2 : 3;
}

int order_of(ElementKind kind) { return record_of(kind).order; }

std::span<const ReferenceFacet> facets_of(ElementKind kind) {
  static const std::vector<std::vector<ReferenceFacet>> kFacets = [] {
    std::vector<std::vector<ReferenceFacet>> all;
    all.reserve(kKinds.size());
    for (const KindRecord& record : kKinds) all.push_back(make_facets(record));
    return all;
  }();
  return kFacets.at(static_cast<std::size_t>(kind));
}

}  // namespace flexneck::mesher
