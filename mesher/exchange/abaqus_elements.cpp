// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/abaqus_elements.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

/// The first of a kind is the one that is written, the one in R its reduced integration.
constexpr std::array<std::pair<std::string_view, ElementKind>, 7> kTypes = {
    {{"C3D8", ElementKind::hex8},
     {"C3D8I", ElementKind::hex8},
     {"C3D8R", ElementKind::hex8},
     {"C3D10", ElementKind::tet10},
     {"C3D15", ElementKind::prism15},
     {"C3D20", ElementKind::hex20},
     {"C3D20R", ElementKind::hex20}}};

}  // namespace

std::optional<ElementKind> kind_of_abaqus_type(std::string_view type) {
  const auto* const found = std::find_if(kTypes.begin(), kTypes.end(),
                                         [&](const auto& row) { return row.first == type; });
  return found == kTypes.end() ? std::nullopt : std::optional(found->second);
}

std::string known_abaqus_types() {
  std::string known;
  for (const auto& [type, kind] : kTypes) {
    known += (known.empty() ? "" : ", ") + std::string(type);
  }
  return known;
}

std::string abaqus_type_of(ElementKind kind, bool is_reduced) {
  const auto* const found = std::find_if(kTypes.begin(), kTypes.end(),
                                         [&](const auto& row) { return row.second == kind; });
  if (found != kTypes.end()) {
    const std::string reduced = std::string(found->first) + "R";
    return is_reduced && kind_of_abaqus_type(reduced) ? reduced : std::string(found->first);
  }
  throw InputError("an .inp has no element of kind " + std::string(name_of(kind)) +
                   "; mesh with the 20-node one instead (mesh.element = \"hex20\")");
}

std::span<const std::vector<std::size_t>> abaqus_facets(ElementKind kind) {
  using Sides = std::vector<std::vector<std::size_t>>;
  static const Sides kHexahedron = {{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1},
                                    {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  static const Sides kPrism = {{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const Sides kTetrahedron = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
  switch (shape_of(kind)) {
    case ReferenceShape::hexahedron:
      return kHexahedron;
    case ReferenceShape::prism:
      return kPrism;
    case ReferenceShape::tetrahedron:
      return kTetrahedron;
    default:
      return {};
  }
}

}  // namespace flexneck::mesher
