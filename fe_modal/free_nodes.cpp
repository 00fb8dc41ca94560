// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/free_nodes.h"

namespace flexneck::fe_modal {

FreeNodes::FreeNodes(std::size_t node_count, std::span<const std::int32_t> held)
    : indices_(node_count, 0) {
  for (const std::int32_t node : held) indices_.at(static_cast<std::size_t>(node)) = -1;
  std::int32_t next = 0;
  for (std::int32_t& index : indices_) {
    if (index == 0) index = next++;
  }
  free_count_ = next;
}

Eigen::Matrix3Xd FreeNodes::expand(const Eigen::VectorXd& free_values) const {
  Eigen::Matrix3Xd field = Eigen::Matrix3Xd::Zero(3, node_count());
  for (std::size_t k = 0; k < indices_.size(); ++k) {
    if (indices_[k] < 0) continue;
    field.col(static_cast<Eigen::Index>(k)) = free_values.segment<3>(3 * indices_[k]);
  }
  return field;
}

Eigen::VectorXd FreeNodes::restrict(const Eigen::Matrix3Xd& field) const {
  Eigen::VectorXd values(dof_count());
  for (std::size_t k = 0; k < indices_.size(); ++k) {
    if (indices_[k] < 0) continue;
    values.segment<3>(3 * indices_[k]) = field.col(static_cast<Eigen::Index>(k));
  }
  return values;
}

}  // namespace flexneck::fe_modal
