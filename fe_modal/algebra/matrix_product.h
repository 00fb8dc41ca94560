// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/ranks.h"

namespace flexneck::fe_modal {

/// Products by the BLAS, which knows the processor that it runs on; a portable build of Eigen does
/// not: 81 x 27 by 27 x 81 takes 7 us, with Eigen 24 us for one half.
using MatrixView = Eigen::Ref<const Eigen::MatrixXd>;

/// result = factor a b + keep result, of shapes that fit.
void multiply(double factor, const MatrixView& a, const MatrixView& b, double keep,
              Eigen::Ref<Eigen::MatrixXd> result);
/// result = factor a b^T + keep result
void multiply_by_transpose(double factor, const MatrixView& a, const MatrixView& b, double keep,
                           Eigen::Ref<Eigen::MatrixXd> result);
/// result = factor a^T b + keep result
void multiply_transpose(double factor, const MatrixView& a, const MatrixView& b, double keep,
                        Eigen::Ref<Eigen::MatrixXd> result);
/// a^T b over the rows of all ranks. Collective.
Eigen::MatrixXd inner_products(const Ranks& ranks, const MatrixView& a, const MatrixView& b);
/// Products of each column of a with that of b, over the rows of all ranks. Collective.
Eigen::VectorXd column_products(const Ranks& ranks, const MatrixView& a, const MatrixView& b);

}  // namespace flexneck::fe_modal
