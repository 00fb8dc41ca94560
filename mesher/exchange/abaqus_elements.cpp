// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/abaqus_elements.h"

#include <algorithm>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

bool has(std::span<const std::string_view> types, std::string_view type) {
  return std::find(types.begin(), types.end(), type) != types.end();
}

}  // namespace

std::optional<ElementKind> kind_of_abaqus_type(std::string_view type) {
  for (const ElementKind kind : element_kinds())
    if (has(traits_of(kind).abaqus_types, type)) return kind;
  return std::nullopt;
}

std::string known_abaqus_types() {
  std::string known;
  for (const ElementKind kind : element_kinds())
    for (const std::string_view type : traits_of(kind).abaqus_types)
      known += (known.empty() ? "" : ", ") + std::string(type);
  return known;
}

std::string abaqus_type_of(ElementKind kind, bool is_reduced) {
  const auto types = traits_of(kind).abaqus_types;
  if (types.empty())
    throw InputError("an .inp file has no element of kind " + std::string(name_of(kind)) +
                     "; use a mesh with hex20, prism15 or tet10");
  const std::string full(types.front());
  return is_reduced && has(types, full + "R") ? full + "R" : full;
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
