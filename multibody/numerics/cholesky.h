// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace flexneck::multibody {

/// Replaces the lower triangle of a symmetric positive definite matrix, of fixed or dynamic size,
/// by its Cholesky factor L, with 1 / L_ii on the diagonal. For the 6 to 40 rows of a body plain
/// loops along columns are faster than a blocked library. A matrix that is not positive definite
/// gives NaN, which the caller sees in the result.
template <typename Matrix>
void factorise_cholesky(Matrix& matrix) {
  const Eigen::Index n = matrix.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    double* const column_k = &matrix(0, k);
    const double scale = 1 / std::sqrt(column_k[k]);
    column_k[k] = scale;
    for (Eigen::Index i = k + 1; i < n; ++i) column_k[i] *= scale;
    for (Eigen::Index j = k + 1; j < n; ++j) {
      double* const column_j = &matrix(0, j);
      const double factor = column_k[j];
      for (Eigen::Index i = j; i < n; ++i) column_j[i] -= factor * column_k[i];
    }
  }
}

/// values <- L^-1 values; a row of `values` may hold several right-hand sides.
template <typename Matrix, typename Values>
void solve_lower(const Matrix& factor, Values&& values) {
  const Eigen::Index n = factor.rows();
  for (Eigen::Index k = 0; k < n; ++k) {
    values.row(k) *= factor(k, k);
    for (Eigen::Index i = k + 1; i < n; ++i) values.row(i) -= factor(i, k) * values.row(k);
  }
}

/// values <- L^-T values, for one right-hand side.
template <typename Matrix, typename Values>
void solve_upper(const Matrix& factor, Values&& values) {
  const Eigen::Index n = factor.rows();
  for (Eigen::Index k = n; k-- > 0;) {
    double sum = values[k];
    for (Eigen::Index i = k + 1; i < n; ++i) sum -= factor(i, k) * values[i];
    values[k] = sum * factor(k, k);
  }
}

}  // namespace flexneck::multibody
