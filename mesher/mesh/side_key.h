// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// Corner nodes of a side in ascending order, which is the same for the elements on either side of
/// it. A triangle's key begins with -1.
using SideKey = std::array<std::int32_t, 4>;

/// @param nodes of the face, the corners first
inline SideKey key_of_face(ElementKind face_kind, std::span<const std::int32_t> nodes) {
  SideKey key;
  key.fill(-1);
  std::copy_n(nodes.begin(), corners_per_element(face_kind), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

/// @param nodes of the whole element
inline SideKey key_of_side(const Side& side, std::span<const std::int32_t> nodes) {
  SideKey key;
  key.fill(-1);
  const std::size_t corners = corners_per_element(side.kind);
  for (std::size_t c = 0; c < corners; ++c) key[c] = nodes[side.nodes[c]];
  std::sort(key.begin(), key.end());
  return key;
}

}  // namespace flexneck::mesher
