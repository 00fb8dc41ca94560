// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck {

/// Eigenvalues of small symmetric matrices by Eigen, compiled once: a source with its own copy of
/// Eigen's solver takes six seconds longer. Of matrices with entries that are not finite, results
/// are not either.

struct SymmetricPairs {
  Eigen::VectorXd values;   ///< (n), ascending
  Eigen::MatrixXd vectors;  ///< (n, n), orthonormal, in B where one is given
};

/// A x = lambda x; of A the lower half is read.
SymmetricPairs symmetric_pairs(const Eigen::MatrixXd& a);
/// A x = lambda B x with a positive definite B.
SymmetricPairs symmetric_pairs(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// The values alone.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace flexneck
