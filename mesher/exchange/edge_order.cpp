// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/edge_order.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace flexneck::mesher {
namespace {

using Group = std::vector<std::size_t>;

/// For each node after the corners, the corners around it: two for an edge, four for a face, eight
/// for the centre.
std::vector<Group> groups_of(ReferenceShape shape) {
  switch (shape) {
    case ReferenceShape::hexahedron:
      return {{0, 1},
              {1, 2},
              {2, 3},
              {3, 0},
              {4, 5},
              {5, 6},
              {6, 7},
              {7, 4},
              {0, 4},
              {1, 5},
              {2, 6},
              {3, 7},
              {0, 3, 4, 7},
              {1, 2, 5, 6},
              {0, 1, 4, 5},
              {2, 3, 6, 7},
              {0, 1, 2, 3},
              {4, 5, 6, 7},
              {0, 1, 2, 3, 4, 5, 6, 7}};
    case ReferenceShape::prism:
      return {{0, 1}, {1, 2}, {2, 0}, {3, 4},       {4, 5},       {5, 3},
              {0, 3}, {1, 4}, {2, 5}, {0, 1, 3, 4}, {1, 2, 4, 5}, {0, 2, 3, 5}};
    case ReferenceShape::tetrahedron:
      return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    case ReferenceShape::pyramid:
      return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}, {0, 1, 2, 3}};
    case ReferenceShape::quadrilateral:
      return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 1, 2, 3}};
    case ReferenceShape::triangle:
      return {{0, 1}, {1, 2}, {2, 0}};
  }
  return {};
}

}  // namespace

std::vector<std::size_t> edge_order(ElementKind kind) {
  const auto nodes = reference_nodes(kind);
  std::vector<std::size_t> order(corners_per_element(kind));
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (const Group& group : groups_of(shape_of(kind))) {
    if (order.size() == nodes.size()) break;
    std::array<double, 3> middle{};
    for (const std::size_t corner : group) {
      for (std::size_t d = 0; d < 3; ++d) {
        middle[d] += nodes[corner][d] / static_cast<double>(group.size());
      }
    }
    const auto found = std::find(nodes.begin(), nodes.end(), middle);
    order.push_back(static_cast<std::size_t>(found - nodes.begin()));
  }
  return order;
}

}  // namespace flexneck::mesher
