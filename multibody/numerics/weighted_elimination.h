// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/QR>

namespace flexneck::multibody {

/// Solves [I Y; Y^T 0] [y; lambda] = [z; s] by the QR factorisation of Y, where the Cholesky
/// factorisation of Y^T Y would lose too many digits: as many as the logarithm of the ratio of the
/// masses, while the QR factorisation loses none that matter. Rows sorted by size and column
/// pivoting make it stable row by row (Cox and Higham, SIAM J. Matrix Anal. Appl. 19, 1998). Dense.
class WeightedElimination {
 public:
  /// @param Y  (n, m) of rank m
  void factorise(const Eigen::MatrixXd& Y);
  /// @param z  (n), becomes y
  /// @param s  (m), becomes lambda
  void solve(Eigen::Ref<Eigen::VectorXd> z, Eigen::Ref<Eigen::VectorXd> s) const;

 private:
  void solve_once(Eigen::VectorXd& z, Eigen::VectorXd& s) const;

  Eigen::MatrixXd Y_;
  std::vector<Eigen::Index> order_;  ///< rows of Y, the largest first
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors_;
};

}  // namespace flexneck::multibody
