// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/dof_layout.h"

#include "fe_modal/algebra/communicator.h"

namespace flexneck::fe_modal {

DofLayout::DofLayout(Eigen::Index block_count, const Ranks& alone)
    : ranks_(alone), dof_count_(3 * block_count), own_dof_count_(dof_count_) {}

DofLayout::DofLayout(const Ranks& ranks, const std::vector<int>& block_counts) : ranks_(ranks) {
  int rows = 0;
  for (const int count : block_counts) {
    counts_.push_back(3 * count);
    offsets_.push_back(rows);
    rows += 3 * count;
  }
  dof_count_ = rows;
  own_dof_count_ = counts_[static_cast<std::size_t>(ranks.own())];
  first_own_dof_ = offsets_[static_cast<std::size_t>(ranks.own())];
}

Eigen::MatrixXd DofLayout::whole(const Eigen::MatrixXd& own) const {
  if (!ranks_.are_many()) return own;
  Eigen::MatrixXd result(dof_count(), own.cols());
  for (Eigen::Index k = 0; k < own.cols(); ++k) {
    require_mpi(MPI_Allgatherv(own.col(k).data(), static_cast<int>(own.rows()), MPI_DOUBLE,
                               result.col(k).data(), counts_.data(), offsets_.data(), MPI_DOUBLE,
                               communicator(ranks_)));
  }
  return result;
}

}  // namespace flexneck::fe_modal
