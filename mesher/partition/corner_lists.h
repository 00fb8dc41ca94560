// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "mesher/mesh/mesh.h"
#include "mesher/partition/metis.h"

namespace flexneck::mesher {

/// Corner nodes of the elements, in compressed rows as METIS takes them.
struct CornerLists {
  std::vector<idx_t> offsets = {0};
  std::vector<idx_t> corners;
};

inline CornerLists corner_lists(const Mesh& mesh) {
  CornerLists lists;
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t width = nodes_per_element(block.kind);
    const auto corners = static_cast<std::ptrdiff_t>(corners_per_element(block.kind));
    for (std::size_t e = 0; e < block.size(); ++e) {
      const auto first = block.nodes.begin() + static_cast<std::ptrdiff_t>(e * width);
      lists.corners.insert(lists.corners.end(), first, first + corners);
      lists.offsets.push_back(static_cast<idx_t>(lists.corners.size()));
    }
  }
  return lists;
}

}  // namespace flexneck::mesher
