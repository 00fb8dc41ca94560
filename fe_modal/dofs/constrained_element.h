// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/dofs/dof_map.h"

namespace flexneck::fe_modal {

/// An element in the blocks of degrees of freedom that remain under constraints: T^T E T with the
/// motions u = T q of its sites.
class ConstrainedElement {
 public:
  /// @param sites nodes, and for point elements the sites of reference points
  ConstrainedElement(std::span<const std::int32_t> sites, const DofMap& dof_map);

  /// Block number of each of m places, -1 if fixed.
  std::span<const std::int32_t> numbers() const { return numbers_; }
  /// T^T E T, (3m, 3m) with degree of freedom a m + i, for an element's matrix E, (3n, 3n).
  Eigen::MatrixXd reduced(Eigen::MatrixXd element) const;

 private:
  std::vector<std::int32_t> numbers_;
  Eigen::MatrixXd motion_;  ///< T, (3n, 3m); empty if nothing is constrained
};

/// Expands an element's mass between nodes, (n, n), to all three directions, (3n, 3n).
Eigen::MatrixXd in_three_directions(const Eigen::MatrixXd& mass);

}  // namespace flexneck::fe_modal
