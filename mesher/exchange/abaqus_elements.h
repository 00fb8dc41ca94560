// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// The element kind of TYPE= of Abaqus or CalculiX: C3D8, C3D8I, C3D8R, C3D10, C3D15, C3D20,
/// C3D20R; in capitals. A mesh does not store how an element is integrated.
std::optional<ElementKind> kind_of_abaqus_type(std::string_view type);
/// All known types, for messages.
std::string known_abaqus_types();

/// The type as which a kind is written.
/// @throws InputError for hex27 and prism18, which have none.
std::string abaqus_type_of(ElementKind kind, bool is_reduced);

/// Corners, as local nodes in the order of ElementKind, of the facets that Abaqus calls S1, S2, …
/// (the CalculiX manual numbers them alike).
std::span<const std::vector<std::size_t>> abaqus_facets(ElementKind kind);

}  // namespace flexneck::mesher
