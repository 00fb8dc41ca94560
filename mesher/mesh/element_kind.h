// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <string_view>
#include <vector>

namespace flexneck::mesher {

/// Kinds of volume and surface elements that a mesh may hold. Node orders are those of
/// reference_nodes().
enum class ElementKind {
  hex8,       ///< trilinear hexahedron
  hex20,      ///< serendipity hexahedron
  hex27,      ///< triquadratic hexahedron
  prism6,     ///< linear prism
  prism15,    ///< serendipity prism
  prism18,    ///< quadratic prism
  tet4,       ///< linear tetrahedron
  tet10,      ///< quadratic tetrahedron
  pyramid5,   ///< linear pyramid
  pyramid13,  ///< serendipity pyramid
  pyramid14,  ///< quadratic pyramid
  quad4,      ///< bilinear quadrilateral, face of hex8, prism6 and pyramid5
  quad8,      ///< serendipity quadrilateral, face of hex20, prism15 and pyramid13
  quad9,      ///< biquadratic quadrilateral, face of hex27, prism18 and pyramid14
  tri3,       ///< linear triangle, face of linear prisms, tetrahedra and pyramids
  tri6,       ///< quadratic triangle, face of the quadratic and serendipity ones
};

std::string_view name_of(ElementKind kind);
/// The kind of this name.
/// @throws InputError if there is none.
ElementKind element_kind_from(std::string_view name);

/// Reference elements: [-1, 1]^d, or the simplex xi, eta, zeta >= 0 with sum <= 1; the prism is the
/// triangle times zeta in [-1, 1]; the pyramid has the base [-1, 1]^2 at zeta = 0 and its apex at
/// zeta = 1.
enum class ReferenceShape { hexahedron, prism, tetrahedron, pyramid, quadrilateral, triangle };

/// Exponents (a, b, c), each up to two, of a function xi^a eta^b zeta^c; for a pyramid of (xi /
/// w)^a (eta / w)^b w^max(a, b) zeta^c with w = 1 - zeta, which is a polynomial on each side
/// (Bergot, Cohen and Durufle, J. Sci. Comput. 42 (2010) 345).
using Exponents = std::array<int, 3>;

/// All properties of a kind. A new kind is an enumerator and a row of these in element_kind.cpp;
/// the schemes of fe_modal/element define its use in the analysis.
struct ElementTraits {
  ElementKind kind;
  std::string_view name;
  ReferenceShape shape;
  int order;
  std::span<const std::array<double, 3>> nodes;  ///< see reference_nodes()
  bool (*spans)(const Exponents&);               ///< true for the functions that span the shape
                                                 ///< functions
  int gmsh_type;
  int vtk_type;                                      ///< in VTK's files (vtkCellType.h)
  std::string_view xdmf_topology;                    ///< in the XDMF model, version 2 and 3
  std::span<const std::string_view> abaqus_types{};  ///< the first is written; the one in R has
                                                     ///< reduced integration
  /// Number of nodes of the XDMF topology; further nodes are not shown.
  std::size_t xdmf_nodes = nodes.size();
};
const ElementTraits& traits_of(ElementKind kind);

/// All kinds, in the order of the enumeration.
std::span<const ElementKind> element_kinds();
/// The kind whose nodes are the corners of the shape.
ElementKind linear_kind_of(ReferenceShape shape);
ReferenceShape shape_of(ElementKind kind);

/// Coordinates of the nodes in the reference element, unused ones zero. Nodes follow gmsh's order:
/// corners, edges, faces, centre.
std::span<const std::array<double, 3>> reference_nodes(ElementKind kind);
inline std::size_t nodes_per_element(ElementKind kind) { return reference_nodes(kind).size(); }
std::size_t corners_per_element(ElementKind kind);
/// Number of reference coordinates: 3 for volumes, 2 for surfaces.
int dimension(ElementKind kind);
/// 1 or 2: the degree of the complete polynomials among the shape functions.
int order_of(ElementKind kind);

/// A facet of a volume element: its kind and its local nodes in the order of that kind, so that
/// dx/dxi x dx/deta points outwards.
struct ReferenceFacet {
  ElementKind kind;
  std::vector<std::size_t> nodes;
};
/// The facets of a volume element; none for a surface element.
std::span<const ReferenceFacet> facets_of(ElementKind kind);

}  // namespace flexneck::mesher
