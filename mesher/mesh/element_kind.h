// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <string_view>

namespace flexneck::mesher {

/// Kinds of volume and surface elements that a mesh may hold. Node orders are those of
/// reference_nodes().
enum class ElementKind {
  hex27,  ///< triquadratic hexahedron
  quad9,  ///< biquadratic quadrilateral, face of hex27
};

std::string_view name_of(ElementKind kind);
/// @throws InputError if no kind has this name.
ElementKind element_kind_from(std::string_view name);

/// Coordinates of the nodes in the reference element [-1, 1]^d, unused ones zero. Nodes follow
/// gmsh's order: corners, edges, faces, centre.
std::span<const std::array<double, 3>> reference_nodes(ElementKind kind);
inline std::size_t nodes_per_element(ElementKind kind) { return reference_nodes(kind).size(); }
/// 3 for volumes, 2 for surfaces.
int dimension(ElementKind kind);

}  // namespace flexneck::mesher
