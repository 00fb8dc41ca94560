// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/element_kind.h"

#include <algorithm>
#include <string>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

using Point = std::array<double, 3>;

// Nodes of the kinds with the most nodes of each shape. Kinds with fewer have the first of them, in
// the same order.

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

constexpr std::array<Point, 14> kPyramidNodes = {{
    // corners
    {-1, -1, 0},
    {1, -1, 0},
    {1, 1, 0},
    {-1, 1, 0},
    {0, 0, 1},
    // edges
    {0, -1, 0},
    {-1, 0, 0},
    {-0.5, -0.5, 0.5},
    {1, 0, 0},
    {0.5, -0.5, 0.5},
    {0, 1, 0},
    {0.5, 0.5, 0.5},
    {-0.5, 0.5, 0.5},
    // base
    {0, 0, 0},
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

/// True for the monomials of serendipity elements: their superlinear degree, the sum of the
/// exponents above one, is at most two (Arnold and Awanou, Found. Comput. Math. 11 (2011) 337).
constexpr bool is_serendipity(const Exponents& e) {
  int degree = 0;
  for (const int exponent : e) degree += exponent > 1 ? exponent : 0;
  return degree <= 2;
}
constexpr bool is_multilinear(const Exponents& e) { return e[0] <= 1 && e[1] <= 1 && e[2] <= 1; }
constexpr bool is_any(const Exponents&) { return true; }
constexpr bool is_linear(const Exponents& e) { return e[0] + e[1] + e[2] <= 1; }
constexpr bool is_quadratic(const Exponents& e) { return e[0] + e[1] + e[2] <= 2; }
constexpr bool is_linear_prism(const Exponents& e) { return e[0] + e[1] <= 1 && e[2] <= 1; }
constexpr bool is_serendipity_prism(const Exponents& e) {
  return e[0] + e[1] <= 2 && (e[2] <= 1 || e[0] + e[1] <= 1);
}
constexpr bool is_quadratic_prism(const Exponents& e) { return e[0] + e[1] <= 2; }
constexpr int pyramid_degree(const Exponents& e) { return std::max(e[0], e[1]) + e[2]; }
constexpr bool is_linear_pyramid(const Exponents& e) { return pyramid_degree(e) <= 1; }
constexpr bool is_serendipity_pyramid(const Exponents& e) {
  return pyramid_degree(e) <= 2 && e[0] + e[1] <= 3;
}
constexpr bool is_quadratic_pyramid(const Exponents& e) { return pyramid_degree(e) <= 2; }

constexpr std::array<std::string_view, 3> kC3D8 = {"C3D8", "C3D8I", "C3D8R"};
constexpr std::array<std::string_view, 2> kC3D20 = {"C3D20", "C3D20R"};
constexpr std::array<std::string_view, 1> kC3D6 = {"C3D6"};
constexpr std::array<std::string_view, 1> kC3D15 = {"C3D15"};
constexpr std::array<std::string_view, 1> kC3D4 = {"C3D4"};
constexpr std::array<std::string_view, 1> kC3D10 = {"C3D10"};

constexpr std::array<ElementTraits, 16> kKinds = {{
    {ElementKind::hex8, "hex8", ReferenceShape::hexahedron, 1, std::span(kHexahedronNodes).first(8),
     is_multilinear, 5, 12, "Hexahedron", kC3D8},
    {ElementKind::hex20, "hex20", ReferenceShape::hexahedron, 2,
     std::span(kHexahedronNodes).first(20), is_serendipity, 17, 25, "Hexahedron_20", kC3D20},
    {ElementKind::hex27, "hex27", ReferenceShape::hexahedron, 2, kHexahedronNodes, is_any, 12, 29,
     "Hexahedron_27"},
    {ElementKind::prism6, "prism6", ReferenceShape::prism, 1, std::span(kPrismNodes).first(6),
     is_linear_prism, 6, 13, "Wedge", kC3D6},
    {ElementKind::prism15, "prism15", ReferenceShape::prism, 2, std::span(kPrismNodes).first(15),
     is_serendipity_prism, 18, 26, "Wedge_15", kC3D15},
    {ElementKind::prism18, "prism18", ReferenceShape::prism, 2, kPrismNodes, is_quadratic_prism, 13,
     32, "Wedge_18"},
    {ElementKind::tet4, "tet4", ReferenceShape::tetrahedron, 1,
     std::span(kTetrahedronNodes).first(4), is_linear, 4, 10, "Tetrahedron", kC3D4},
    {ElementKind::tet10, "tet10", ReferenceShape::tetrahedron, 2, kTetrahedronNodes, is_quadratic,
     11, 24, "Tetrahedron_10", kC3D10},
    {ElementKind::pyramid5, "pyramid5", ReferenceShape::pyramid, 1,
     std::span(kPyramidNodes).first(5), is_linear_pyramid, 7, 14, "Pyramid"},
    {ElementKind::pyramid13, "pyramid13", ReferenceShape::pyramid, 2,
     std::span(kPyramidNodes).first(13), is_serendipity_pyramid, 19, 27, "Pyramid_13"},
    {ElementKind::pyramid14,
     "pyramid14",
     ReferenceShape::pyramid,
     2,
     kPyramidNodes,
     is_quadratic_pyramid,
     14,
     27,
     "Pyramid_13",
     {},
     13},
    {ElementKind::quad4, "quad4", ReferenceShape::quadrilateral, 1,
     std::span(kQuadrilateralNodes).first(4), is_multilinear, 3, 9, "Quadrilateral"},
    {ElementKind::quad8, "quad8", ReferenceShape::quadrilateral, 2,
     std::span(kQuadrilateralNodes).first(8), is_serendipity, 16, 23, "Quadrilateral_8"},
    {ElementKind::quad9, "quad9", ReferenceShape::quadrilateral, 2, kQuadrilateralNodes, is_any, 10,
     28, "Quadrilateral_9"},
    {ElementKind::tri3, "tri3", ReferenceShape::triangle, 1, std::span(kTriangleNodes).first(3),
     is_linear, 2, 5, "Triangle"},
    {ElementKind::tri6, "tri6", ReferenceShape::triangle, 2, kTriangleNodes, is_quadratic, 9, 22,
     "Triangle_6"},
}};
static_assert(
    [] {
      for (std::size_t k = 0; k < kKinds.size(); ++k)
        if (kKinds[k].kind != static_cast<ElementKind>(k)) return false;
      return true;
    }(),
    "rows in the order of the enumeration");

using Corners = std::vector<std::size_t>;

/// Corners of the facets, counter-clockwise from outside.
std::vector<Corners> facet_corners(ReferenceShape shape) {
  switch (shape) {
    case ReferenceShape::hexahedron:
      return {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}};
    case ReferenceShape::prism:
      return {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
    case ReferenceShape::tetrahedron:
      return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    case ReferenceShape::pyramid:
      return {{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    default:
      return {};
  }
}

/// Appends the node in the middle of some others, if the kind has one there.
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

ElementKind facet_kind(ReferenceShape shape, std::size_t nodes) {
  const auto* const found = std::find_if(
      kKinds.begin(), kKinds.end(),
      [&](const ElementTraits& each) { return each.shape == shape && each.nodes.size() == nodes; });
  return found->kind;
}

std::vector<ReferenceFacet> make_facets(const ElementTraits& record) {
  std::vector<ReferenceFacet> sides;
  for (const Corners& corners : facet_corners(record.shape)) {
    Corners side = corners;
    for (std::size_t c = 0; c < corners.size(); ++c) {
      append_middle(record.nodes, {corners[c], corners[(c + 1) % corners.size()]}, side);
    }
    if (corners.size() == 4) append_middle(record.nodes, corners, side);
    const ReferenceShape shape =
        corners.size() == 3 ? ReferenceShape::triangle : ReferenceShape::quadrilateral;
    sides.push_back({facet_kind(shape, side.size()), side});
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

const ElementTraits& traits_of(ElementKind kind) {
  return kKinds.at(static_cast<std::size_t>(kind));
}

std::string_view name_of(ElementKind kind) { return traits_of(kind).name; }

ElementKind linear_kind_of(ReferenceShape shape) {
  return std::find_if(
             kKinds.begin(), kKinds.end(),
             [&](const ElementTraits& each) { return each.shape == shape && each.order == 1; })
      ->kind;
}

ElementKind element_kind_from(std::string_view name) {
  std::string known;
  for (const ElementTraits& record : kKinds) {
    if (record.name == name) return record.kind;
    known += (known.empty() ? "" : ", ") + std::string(record.name);
  }
  throw InputError("unknown element kind '" + std::string(name) + "', expected one of " + known);
}

ReferenceShape shape_of(ElementKind kind) { return traits_of(kind).shape; }

std::span<const std::array<double, 3>> reference_nodes(ElementKind kind) {
  return traits_of(kind).nodes;
}

std::size_t corners_per_element(ElementKind kind) {
  return nodes_per_element(linear_kind_of(shape_of(kind)));
}

int dimension(ElementKind kind) {
  const ReferenceShape shape = shape_of(kind);
  return shape == ReferenceShape::quadrilateral || shape == ReferenceShape::triangle ? 2 : 3;
}

int order_of(ElementKind kind) { return traits_of(kind).order; }

std::span<const ReferenceFacet> facets_of(ElementKind kind) {
  static const std::vector<std::vector<ReferenceFacet>> kFacets = [] {
    std::vector<std::vector<ReferenceFacet>> all;
    all.reserve(kKinds.size());
    for (const ElementTraits& record : kKinds) all.push_back(make_facets(record));
    return all;
  }();
  return kFacets.at(static_cast<std::size_t>(kind));
}

}  // namespace flexneck::mesher
