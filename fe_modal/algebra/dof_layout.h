// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/ranks.h"

namespace flexneck::fe_modal {

/// Which rank has which rows of vectors. Rows come in blocks of three; a rank has those of the
/// blocks that it owns, in ascending order of their numbers. Alone it has all of them.
class DofLayout {
 public:
  /// All on this process.
  explicit DofLayout(Eigen::Index block_count, const Ranks& alone = {});
  /// @param owner_of_block (blocks) the rank that owns each; the same on all ranks
  DofLayout(const Ranks& ranks, std::vector<std::int32_t> owner_of_block);

  const Ranks& ranks() const { return ranks_; }
  Eigen::Index dof_count() const { return 3 * block_count_; }
  Eigen::Index own_dof_count() const { return 3 * own_block_count_; }
  Eigen::Index own_block_count() const { return own_block_count_; }

  /// The rank that owns a block, and the block's place among those that this rank owns.
  std::int32_t owner(std::int32_t block) const {
    return owners_.empty() ? 0 : owners_[static_cast<std::size_t>(block)];
  }
  std::int32_t place(std::int32_t block) const {
    return places_.empty() ? block : places_[static_cast<std::size_t>(block)];
  }

  /// This rank's rows of columns that it has whole, (dofs, k) -> (own dofs, k).
  Eigen::MatrixXd own_rows(const Eigen::MatrixXd& whole) const;
  /// Collective: the whole columns on every rank, (own dofs, k) -> (dofs, k).
  Eigen::MatrixXd whole(const Eigen::MatrixXd& own) const;

 private:
  /// Where a block's rows begin if those of the ranks come one after the other.
  Eigen::Index place_by_rank(std::size_t block) const {
    return offsets_[static_cast<std::size_t>(owners_[block])] + 3 * places_[block];
  }

  Ranks ranks_;
  Eigen::Index block_count_ = 0;
  Eigen::Index own_block_count_ = 0;
  std::vector<std::int32_t> owners_;  ///< (blocks); empty: all are this process's
  std::vector<std::int32_t> places_;  ///< (blocks) among those of the same owner; likewise
  std::vector<int> counts_;           ///< (ranks) rows that each owns; likewise
  std::vector<int> offsets_;          ///< (ranks) rows of the ranks before; likewise
};

}  // namespace flexneck::fe_modal
