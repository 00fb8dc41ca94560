// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// result = factor a b^T + keep result, by the BLAS, which knows the processor that it runs on; a
/// portable build of Eigen does not: 81 x 27 by 27 x 81 takes 7 us, with Eigen 24 us for one half.
/// @pre the shapes fit; result has its shape already.
void multiply_by_transpose(double factor, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                           double keep, Eigen::MatrixXd& result);

/// result = a b
void multiply(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& result);

}  // namespace flexneck::fe_modal
