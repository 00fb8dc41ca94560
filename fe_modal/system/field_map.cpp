// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/field_map.h"

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

namespace {

/// Makes a column for each field; `make` computes the values of all its degrees of freedom.
template <typename Make>
Eigen::MatrixXd columns(const DofLayout& layout, std::span<const Eigen::Matrix3Xd> fields,
                        const Make& make) {
  Eigen::MatrixXd result(layout.own_dof_count(), static_cast<Eigen::Index>(fields.size()));
  for (std::size_t k = 0; k < fields.size(); ++k) {
    result.col(static_cast<Eigen::Index>(k)) = layout.own_rows(make(fields[k]));
  }
  return result;
}

}  // namespace

std::vector<Eigen::Matrix3Xd> FieldMap::expand(const Eigen::MatrixXd& vectors) const {
  const Eigen::MatrixXd whole = layout_.whole(vectors);
  std::vector<Eigen::Matrix3Xd> fields;
  fields.reserve(static_cast<std::size_t>(whole.cols()));
  for (const auto& vector : whole.colwise()) fields.push_back(dof_map_->expand(vector));
  return fields;
}

Eigen::MatrixXd FieldMap::gather(std::span<const Eigen::Matrix3Xd> forces) const {
  return columns(layout_, forces,
                 [&](const Eigen::Matrix3Xd& field) { return dof_map_->gather(field); });
}

Eigen::MatrixXd FieldMap::restrict(std::span<const Eigen::Matrix3Xd> fields) const {
  return columns(layout_, fields,
                 [&](const Eigen::Matrix3Xd& field) { return dof_map_->restrict(field); });
}

}  // namespace flexneck::fe_modal
