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

/// Columns next to each other, perhaps some of a wider matrix.
using ConstColumns = Eigen::Ref<const Eigen::MatrixXd>;
/// result += factor a b, long columns times a small matrix, by the BLAS too.
void add_product(double factor, const ConstColumns& a, const ConstColumns& b,
                 Eigen::Ref<Eigen::MatrixXd> result);
/// a^T b of long columns
Eigen::MatrixXd inner_products(const ConstColumns& a, const ConstColumns& b);

}  // namespace flexneck::fe_modal
