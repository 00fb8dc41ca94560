// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/nodal_rows.h"

#include <algorithm>

#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/element/element_product.h"

namespace flexneck::fe_modal {

NodalRows::NodalRows(std::size_t nodes, std::size_t fields)
    : fields_(static_cast<Eigen::Index>(fields)),
      groups_(ElementProduct::groups_of(fields)),
      rows_(nodes * groups_) {}

NodalRows::NodalRows(const DofMap& dof_map, const Eigen::MatrixXd& columns)
    : NodalRows(static_cast<std::size_t>(dof_map.node_count()),
                static_cast<std::size_t>(columns.cols())) {
  const auto nodes = static_cast<std::int32_t>(dof_map.node_count());
  for (std::int32_t node = 0; node < nodes; ++node) {
    const std::int32_t block = dof_map.index(node);
    if (dof_map.is_plain(node) && block < 0) continue;
    auto motions = fields_of(node);
    for (Eigen::Index c = 0; c < fields_; ++c) {
      if (dof_map.is_plain(node)) {
        motions.row(c) = columns.col(c).segment<3>(3 * block).transpose();
      } else {
        motions.row(c) = dof_map.motion_of(node, columns.col(c)).transpose();
      }
    }
  }
}

void NodalRows::take(const NodalRows& from, std::span<const std::int32_t> nodes) {
  auto place = rows_.begin();
  for (const std::int32_t node : nodes) {
    const auto row = from.of(node);
    place = std::copy(row.begin(), row.end(), place);
  }
}

void NodalRows::add_to(NodalRows& to, std::span<const std::int32_t> nodes) const {
  run_with(
      widest_registers(), [&]<std::size_t /*bytes*/>() __attribute__((always_inline)) {
        const RowOf<double>* own = rows_.data();
        for (const std::int32_t node : nodes) {
          add_rows(own, groups_, 1, to.of(node).data());
          own += groups_;
        }
      });
}

void NodalRows::add_product(const Eigen::MatrixXd& matrix, NodalRows& fields) {
  const Eigen::Index n = matrix.rows() / 3;
  for (Eigen::Index a = 0; a < 3; ++a) {
    for (Eigen::Index b = 0; b < 3; ++b) {
      multiply_by_transpose(1, fields.direction(b), matrix.block(a * n, b * n, n, n), 1,
                            direction(a));
    }
  }
}

Eigen::MatrixXd NodalRows::gathered(const DofMap& dof_map) {
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(dof_map.dof_count(), fields_);
  const auto nodes = static_cast<std::int32_t>(dof_map.node_count());
  for (std::int32_t node = 0; node < nodes; ++node) {
    const std::int32_t block = dof_map.index(node);
    if (dof_map.is_plain(node) && block < 0) continue;
    const auto forces = fields_of(node);
    for (Eigen::Index c = 0; c < fields_; ++c) {
      if (dof_map.is_plain(node)) {
        columns.col(c).segment<3>(3 * block) += forces.row(c).transpose();
      } else {
        dof_map.add_force(node, forces.row(c).transpose(), columns.col(c));
      }
    }
  }
  return columns;
}

}  // namespace flexneck::fe_modal
