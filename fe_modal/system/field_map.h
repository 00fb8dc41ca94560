// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/ranks.h"
#include "fe_modal/dofs/dof_map.h"

namespace flexneck::fe_modal {

/// Distribution of the rows of vectors and matrices over the ranks: rows of the first rank come
/// first, three for each block of degrees of freedom.
class DofLayout {
 public:
  /// Puts all rows on this process.
  explicit DofLayout(Eigen::Index block_count, const Ranks& alone = {});
  /// @param block_counts (ranks) the same on all ranks
  DofLayout(const Ranks& ranks, const std::vector<int>& block_counts);

  const Ranks& ranks() const { return ranks_; }
  Eigen::Index dof_count() const { return dof_count_; }
  Eigen::Index own_dof_count() const { return own_dof_count_; }
  Eigen::Index first_own_dof() const { return first_own_dof_; }

  /// This rank's rows of columns that are whole on it, (dofs, k) -> (own dofs, k).
  Eigen::MatrixXd own_rows(const Eigen::MatrixXd& whole) const {
    return whole.middleRows(first_own_dof_, own_dof_count_);
  }
  /// Collective: gathers the whole columns on every rank, (own dofs, k) -> (dofs, k).
  Eigen::MatrixXd whole(const Eigen::MatrixXd& own) const;

 private:
  Ranks ranks_;
  Eigen::Index dof_count_ = 0;
  Eigen::Index own_dof_count_ = 0;
  Eigen::Index first_own_dof_ = 0;
  std::vector<int> counts_;   ///< (ranks) number of rows of each; empty in a serial run
  std::vector<int> offsets_;  ///< (ranks) number of rows of the ranks before; empty in a serial run
};

/// Maps fields on all nodes, (3, n), which are whole on every rank, to vectors of the free degrees
/// of freedom, of which each rank has its rows, and back.
class FieldMap {
 public:
  /// Map of a serial run.
  /// @param dof_map must outlive this
  explicit FieldMap(const DofMap& dof_map) : FieldMap(dof_map, DofLayout(dof_map.free_count())) {}
  FieldMap(const DofMap& dof_map, DofLayout layout)
      : dof_map_(&dof_map), layout_(std::move(layout)) {}

  const DofMap& dof_map() const { return *dof_map_; }
  const DofLayout& layout() const { return layout_; }
  const Ranks& ranks() const { return layout_.ranks(); }
  Eigen::Index node_count() const { return dof_map_->node_count(); }
  Eigen::Index own_dof_count() const { return layout_.own_dof_count(); }

  /// Field of each column, (own dofs, k). Collective.
  std::vector<Eigen::Matrix3Xd> expand(const Eigen::MatrixXd& vectors) const;
  /// Forces on the free degrees of freedom from forces on all nodes, a column each.
  Eigen::MatrixXd gather(std::span<const Eigen::Matrix3Xd> forces) const;
  /// Free values of fields, a column each, as DofMap::restrict().
  Eigen::MatrixXd restrict(std::span<const Eigen::Matrix3Xd> fields) const;

 private:
  const DofMap* dof_map_;
  DofLayout layout_;
};

}  // namespace flexneck::fe_modal
