// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/register_row.h"
#include "fe_modal/dofs/dof_map.h"

namespace flexneck::fe_modal {

/// k fields of some nodes as ElementProduct takes them: rows of eight columns, some groups for each
/// node; column a k + c is direction a of field c.
class NodalRows {
 public:
  NodalRows(std::size_t nodes, std::size_t fields);
  /// The motions of a mesh's nodes.
  /// @param columns (dofs, k)
  NodalRows(const DofMap& dof_map, const Eigen::MatrixXd& columns);

  std::size_t field_count() const { return static_cast<std::size_t>(fields_); }
  void resize(std::size_t nodes) { rows_.resize(nodes * groups_); }
  RowOf<double>* data() { return rows_.data(); }
  /// Takes over the rows of nodes of another, one after the other.
  void take(const NodalRows& from, std::span<const std::int32_t> nodes);
  /// Adds its rows to those of nodes of another.
  void add_to(NodalRows& to, std::span<const std::int32_t> nodes) const;
  /// Adds (matrix, whose degree of freedom a n + i is direction a of node i) times fields.
  void add_product(const Eigen::MatrixXd& matrix, NodalRows& fields);
  /// Forces on a mesh's nodes as those on its degrees of freedom, (dofs, k): the transpose of what
  /// the constructor does.
  Eigen::MatrixXd gathered(const DofMap& dof_map);

 private:
  std::span<RowOf<double>> of(std::int32_t node) {
    return std::span(rows_).subspan(static_cast<std::size_t>(node) * groups_, groups_);
  }
  std::span<const RowOf<double>> of(std::int32_t node) const {
    return std::span(rows_).subspan(static_cast<std::size_t>(node) * groups_, groups_);
  }
  /// (k, 3)
  Eigen::Map<Eigen::MatrixX3d> fields_of(std::int32_t node) {
    return {of(node).front().value, fields_, 3};
  }
  /// Direction a of all fields, (k, nodes).
  Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>> direction(Eigen::Index a) {
    const auto stride = static_cast<Eigen::Index>(groups_ * kColumnsTogether);
    const auto nodes = static_cast<Eigen::Index>(rows_.size() / groups_);
    return {rows_.front().value + a * fields_, fields_, nodes, Eigen::OuterStride<>(stride)};
  }

  Eigen::Index fields_;
  std::size_t groups_;
  std::vector<RowOf<double>> rows_;
};

}  // namespace flexneck::fe_modal
