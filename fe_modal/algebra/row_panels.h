// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// Calls visit(first, rows) for so many rows of some tens of columns as a cache holds.
template <typename Visitor>
void for_each_panel(Eigen::Index size, const Visitor& visit) {
  constexpr Eigen::Index kRows = 1024;
  for (Eigen::Index first = 0; first < size; first += kRows) {
    visit(first, std::min(kRows, size - first));
  }
}

}  // namespace flexneck::fe_modal
