// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/field_map.h"

namespace flexneck::fe_modal {
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
