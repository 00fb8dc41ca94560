// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// A linear map of each column, (n, k) to (n, k).
using BlockOperator = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;

/// The largest eigenpairs of an operator that is self-adjoint and positive in the product x^T M y.
struct RitzPairs {
  Eigen::VectorXd values;   ///< (count), descending
  Eigen::MatrixXd vectors;  ///< (n, count), x^T M x = 1
};

/// Block Lanczos with full reorthogonalisation and thick restart (Golub and Underwood, 1977; Wu and
/// Simon, SIAM J. Matrix Anal. Appl. 22 (2000) 602). A block of start vectors, because solving for
/// eight right-hand sides costs two or three times as much as for one, and because a Krylov space
/// holds as many copies of an eigenvalue as it has start vectors, not one more: where all of a
/// block's worth are found, the search is repeated with a larger one.
/// @param apply the operator times M: takes M x, returns the operator of x
/// @param mass M
/// @param size n
/// @param count at most n
/// @throws ComputationError if it does not converge.
RitzPairs largest_eigenpairs(const BlockOperator& apply, const BlockOperator& mass,
                             Eigen::Index size, Eigen::Index count);

}  // namespace flexneck::fe_modal
