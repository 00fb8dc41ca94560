// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/dof_layout.h"
#include "fe_modal/dofs/dof_map.h"

namespace flexneck::fe_modal {

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
