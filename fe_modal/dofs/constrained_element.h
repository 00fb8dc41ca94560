// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/dof_map.h"

namespace flexneck::fe_modal {

/// An element in the degrees of freedom that rigid couplings and fixed directions leave it: of a
/// coupling that any of its nodes are in, the translation and the rotation take the place of these
/// nodes; what is fixed has zero rows and columns.
class ConstrainedElement {
 public:
  ConstrainedElement(std::span<const std::int32_t> nodes, const DofMap& dof_map);

  /// DofMap' number of each place, -1 if fixed: (m) places, the couplings' last.
  std::span<const std::int32_t> numbers() const { return numbers_; }
  /// T^T E T, (3m, 3m) with degree of freedom a m + i, of an element's matrix (3n, 3n).
  Eigen::MatrixXd reduced(const Eigen::MatrixXd& element) const;

 private:
  std::vector<std::int32_t> numbers_;
  Eigen::MatrixXd motion_;  ///< T, (3n, 3m); empty if nothing is constrained
};

/// An element's mass between nodes, (n, n), in all three directions, (3n, 3n).
Eigen::MatrixXd in_three_directions(const Eigen::MatrixXd& mass);

}  // namespace flexneck::fe_modal
