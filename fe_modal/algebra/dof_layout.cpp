// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/dof_layout.h"

#include <utility>

#include "fe_modal/algebra/communicator.h"

namespace flexneck::fe_modal {

DofLayout::DofLayout(Eigen::Index block_count, const Ranks& alone)
    : ranks_(alone), block_count_(block_count), own_block_count_(block_count) {}

DofLayout::DofLayout(const Ranks& ranks, std::vector<std::int32_t> owner_of_block)
    : ranks_(ranks), block_count_(static_cast<Eigen::Index>(owner_of_block.size())) {
  if (!ranks.are_many()) {
    own_block_count_ = block_count_;
    return;
  }
  owners_ = std::move(owner_of_block);
  std::vector<std::int32_t> counts(static_cast<std::size_t>(ranks.count()), 0);
  places_.reserve(owners_.size());
  for (const std::int32_t owner : owners_) {
    places_.push_back(counts[static_cast<std::size_t>(owner)]++);
  }
  own_block_count_ = counts[static_cast<std::size_t>(ranks.own())];
  int rows = 0;
  for (const std::int32_t count : counts) {
    counts_.push_back(3 * count);
    offsets_.push_back(rows);
    rows += 3 * count;
  }
}

Eigen::MatrixXd DofLayout::own_rows(const Eigen::MatrixXd& whole) const {
  if (owners_.empty()) return whole;
  Eigen::MatrixXd own(own_dof_count(), whole.cols());
  Eigen::Index next = 0;
  for (Eigen::Index block = 0; block < block_count_; ++block) {
    if (owner(static_cast<std::int32_t>(block)) != ranks_.own()) continue;
    own.middleRows<3>(3 * next++) = whole.middleRows<3>(3 * block);
  }
  return own;
}

Eigen::MatrixXd DofLayout::whole(const Eigen::MatrixXd& own) const {
  if (owners_.empty()) return own;
  Eigen::MatrixXd result(dof_count(), own.cols());
  Eigen::VectorXd by_rank(dof_count());
  for (Eigen::Index k = 0; k < own.cols(); ++k) {
    require_mpi(MPI_Allgatherv(own.col(k).data(), static_cast<int>(own.rows()), MPI_DOUBLE,
                               by_rank.data(), counts_.data(), offsets_.data(), MPI_DOUBLE,
                               communicator(ranks_)));
    for (std::size_t block = 0; block < owners_.size(); ++block) {
      result.col(k).segment<3>(3 * static_cast<Eigen::Index>(block)) =
          by_rank.segment<3>(place_by_rank(block));
    }
  }
  return result;
}

}  // namespace flexneck::fe_modal
