// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// Corner nodes of a facet in ascending order, which are the same for the elements on either side
/// of it. A triangle's key begins with -1.
using FacetKey = std::array<std::int32_t, 4>;

/// Key of a facet with these corners.
/// @param corners three or four, in any order
inline FacetKey key_of_corners(std::span<const std::int32_t> corners) {
  FacetKey key;
  key.fill(-1);
  std::copy(corners.begin(), corners.end(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

/// Key of a face.
/// @param nodes of the face, the corners first
inline FacetKey key_of_face(ElementKind face_kind, std::span<const std::int32_t> nodes) {
  return key_of_corners(nodes.first(corners_per_element(face_kind)));
}

/// Key of an element's facet.
/// @param nodes of the whole element
inline FacetKey key_of_facet(const ReferenceFacet& side, std::span<const std::int32_t> nodes) {
  std::array<std::int32_t, 4> corners{};
  const std::size_t count = corners_per_element(side.kind);
  for (std::size_t c = 0; c < count; ++c) corners[c] = nodes[side.nodes[c]];
  return key_of_corners(std::span(corners).first(count));
}

}  // namespace flexneck::mesher
