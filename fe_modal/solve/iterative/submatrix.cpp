// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/submatrix.h"

#include <algorithm>
#include <utility>

namespace flexneck::fe_modal {

NodeGraph restrict_to(const NodeGraph& graph, const std::vector<std::int32_t>& nodes) {
  std::vector<std::int32_t> offsets = {0};
  std::vector<std::int32_t> columns;
  for (const std::int32_t node : nodes) {
    auto place = nodes.begin();
    for (const std::int32_t other : graph.neighbours(node)) {
      place = std::lower_bound(place, nodes.end(), other);
      if (place == nodes.end()) break;
      if (*place == other) columns.push_back(static_cast<std::int32_t>(place - nodes.begin()));
    }
    offsets.push_back(static_cast<std::int32_t>(columns.size()));
  }
  return {std::move(offsets), std::move(columns)};
}

SymmetricMatrix principal_part(const SymmetricMatrix& matrix, const NodeGraph& part,
                               const std::vector<std::int32_t>& nodes) {
  SymmetricMatrix result(part);
  for (std::int32_t row = 0; row < part.node_count(); ++row) {
    const std::int32_t node = nodes[static_cast<std::size_t>(row)];
    const auto later = matrix.later(node);
    for (int a = 0; a < 3; ++a) {
      for (int b = a; b < 3; ++b) result.entry(row, a, -1, b) = matrix.entry(node, a, -1, b);
    }
    const auto own = result.later(row);
    for (std::size_t k = 0; k < own.size(); ++k) {
      const auto place =
          std::lower_bound(later.begin(), later.end(), nodes[static_cast<std::size_t>(own[k])]) -
          later.begin();
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          result.entry(row, a, static_cast<std::ptrdiff_t>(k), b) = matrix.entry(node, a, place, b);
        }
      }
    }
  }
  return result;
}

Eigen::Matrix3d coupling(const SymmetricMatrix& matrix, std::int32_t row, std::int32_t column) {
  if (row > column) return coupling(matrix, column, row).transpose();
  Eigen::Matrix3d result;
  if (row == column) {
    for (int a = 0; a < 3; ++a) {
      for (int b = a; b < 3; ++b) result(a, b) = result(b, a) = matrix.entry(row, a, -1, b);
    }
    return result;
  }
  const auto later = matrix.later(row);
  const auto place = std::lower_bound(later.begin(), later.end(), column) - later.begin();
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) result(a, b) = matrix.entry(row, a, place, b);
  }
  return result;
}

std::vector<std::int32_t> places_in(const std::vector<std::int32_t>& list,
                                    const std::vector<std::int32_t>& values) {
  std::vector<std::int32_t> places;
  places.reserve(values.size());
  auto place = list.begin();
  for (const std::int32_t value : values) {
    place = std::lower_bound(place, list.end(), value);
    places.push_back(static_cast<std::int32_t>(place - list.begin()));
  }
  return places;
}

}  // namespace flexneck::fe_modal
