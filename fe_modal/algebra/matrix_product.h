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
/// Each column of a with that of b, over the rows of all ranks. Collective.
Eigen::VectorXd column_products(const Ranks& ranks, const MatrixView& a, const MatrixView& b);

/// Largest entry of each column on all ranks, 1 where all are zero.
Eigen::VectorXd column_scales(const Ranks& ranks, const Eigen::MatrixXd& columns);
/// action(columns), a linear one in single precision, which knows numbers only down to 1e-38: on
/// columns whose largest entries are 1.
template <typename Action>
Eigen::MatrixXd with_unit_columns(const Ranks& ranks, const Eigen::MatrixXd& columns,
                                  const Action& action) {
  const Eigen::VectorXd scales = column_scales(ranks, columns);
  return action(columns * scales.cwiseInverse().asDiagonal()) * scales.asDiagonal();
}

}  // namespace flexneck::fe_modal
