// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck {

/// Eigenvalues of small symmetric matrices by Eigen, compiled once: a source with its own instance
/// of Eigen's solver takes six seconds longer to compile. If entries of a matrix are not finite,
/// neither are the results.

struct SymmetricPairs {
  Eigen::VectorXd values;   ///< (n), ascending
  Eigen::MatrixXd vectors;  ///< (n, n), orthonormal, with respect to B if one is given
};

/// Solves A x = lambda x; only the lower triangle of A is read.
SymmetricPairs symmetric_pairs(const Eigen::MatrixXd& a);
/// Solves A x = lambda B x with a positive definite B.
SymmetricPairs symmetric_pairs(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// The values alone.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace flexneck
