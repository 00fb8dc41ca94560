// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// Combinations of loads whose static shapes are linearly independent.
struct IndependentLoads {
  /// (n, k): combinations of the n loads whose shapes have K-norm 1 and are K-orthogonal.
  Eigen::MatrixXd combinations;
  Eigen::Index dropped = 0;  ///< n - k
};

/// Drops the combinations that are only rounding: those with less than 1e-10 of the static energy.
/// @param rest F^T X of the shapes X, (n, n): the remainder of the static compliances
/// @param whole diagonal of the static compliances, which makes loads of different units comparable
IndependentLoads independent_loads(const Eigen::MatrixXd& rest, const Eigen::VectorXd& whole);

}  // namespace flexneck::fe_modal
