// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace flexneck::multibody {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Replaces the lower triangle of a symmetric positive definite matrix by its Cholesky factor L,
/// with 1 / L_ii on the diagonal. For the 6 to 40 rows of a body plain loops beat a blocked
/// library. A matrix that is not positive definite leaves NaN behind: the caller sees it in the
/// result.
inline void factorise_cholesky(RowMatrix& matrix) {
  const Eigen::Index n = matrix.rows();
  for (Eigen::Index i = 0; i < n; ++i) {
    double* const row_i = &matrix(i, 0);
    for (Eigen::Index j = 0; j < i; ++j) {
      const double* const row_j = &matrix(j, 0);
      double sum = row_i[j];
      for (Eigen::Index k = 0; k < j; ++k) sum -= row_i[k] * row_j[k];
      row_i[j] = sum * row_j[j];
    }
    double pivot = row_i[i];
    for (Eigen::Index k = 0; k < i; ++k) pivot -= row_i[k] * row_i[k];
    row_i[i] = 1 / std::sqrt(pivot);
  }
}

/// Rows of `values` <- L^-1 values; a row of `values` may hold several right-hand sides.
template <typename Values>
void solve_lower(const RowMatrix& factor, Values&& values) {
  for (Eigen::Index i = 0; i < factor.rows(); ++i) {
    for (Eigen::Index k = 0; k < i; ++k) values.row(i) -= factor(i, k) * values.row(k);
    values.row(i) *= factor(i, i);
  }
}

/// values <- L^-T values, for one right-hand side.
template <typename Values>
void solve_upper(const RowMatrix& factor, Values&& values) {
  for (Eigen::Index i = factor.rows(); i-- > 0;) {
    const double value = values[i] * factor(i, i);
    values[i] = value;
    for (Eigen::Index k = 0; k < i; ++k) values[k] -= factor(i, k) * value;
  }
}

}  // namespace flexneck::multibody
