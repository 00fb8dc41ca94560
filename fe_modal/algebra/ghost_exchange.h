// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/dof_layout.h"
#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// The three rows of each block.
std::vector<std::int32_t> rows_of(std::span<const std::int32_t> blocks);

/// Rows of vectors that a rank works on, of its own and of others. Every member is collective.
class GhostExchange {
 public:
  /// @param rows that this rank works on; alone: all, in their order
  GhostExchange(const DofLayout& layout, std::span<const std::int32_t> rows);

  /// These rows, (own dofs, k) -> (rows, k).
  Eigen::MatrixXd to_local(const Eigen::MatrixXd& own) const;
  /// What all ranks have for the rows that this one owns, added up: (rows, k) -> (own dofs, k).
  Eigen::MatrixXd sum_to_own(const Eigen::MatrixXd& local) const;
  /// A product whose matrix each rank has its summand of; alone nothing is copied.
  template <typename Product>
  Eigen::MatrixXd summed(const Eigen::MatrixXd& own, const Product& product) const {
    if (is_trivial_) return product(own);
    return sum_to_own(product(to_local(own)));
  }

 private:
  Eigen::Index own_rows_;
  Eigen::Index local_rows_;
  bool is_trivial_;    ///< the rows are all and own
  StarForest forest_;  ///< from the owners' scalar rows to the local ones
};

}  // namespace flexneck::fe_modal
