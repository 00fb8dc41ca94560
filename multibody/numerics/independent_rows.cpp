// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/independent_rows.h"

#include <cmath>
#include <numeric>

#include <Eigen/SparseQR>

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

/// QR factors with the columns in the order given; those that depend on the ones before are moved
/// to the end.
using Factors = Eigen::SparseQR<Matrix, Eigen::NaturalOrdering<int>>;

/// Permutation of rows.
struct RowOrder {
  std::vector<int> place;  ///< -1: the row is left out
  int count = 0;
};

/// Row order in which each chosen column's pivot is in a row where it has an entry, so that the
/// factors are as sparse as the columns. Rows without entries in any of them, which the
/// factorisation does not support, are left out.
RowOrder pivot_order(const Matrix& matrix, const std::vector<Index>& chosen) {
  RowOrder order{std::vector<int>(static_cast<std::size_t>(matrix.rows()), -1)};
  for (const bool is_pivot : {true, false})
    for (const Index column : chosen)
      for (Matrix::InnerIterator each(matrix, column); each; ++each) {
        int& place = order.place[static_cast<std::size_t>(each.row())];
        if (place >= 0) continue;
        place = order.count++;
        if (is_pivot) break;
      }
  return order;
}

/// The chosen columns, each divided by its length.
Matrix scaled_columns(const Matrix& from, const std::vector<Index>& chosen, const RowOrder& order,
                      const VectorXd& lengths) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(from.nonZeros()));
  for (std::size_t c = 0; c < chosen.size(); ++c)
    for (Matrix::InnerIterator each(from, chosen[c]); each; ++each) {
      const int row = order.place[static_cast<std::size_t>(each.row())];
      if (row >= 0)
        entries.emplace_back(row, static_cast<int>(c), each.value() / lengths[chosen[c]]);
    }
  Matrix to(order.count, static_cast<Index>(chosen.size()));
  to.setFromTriplets(entries.begin(), entries.end());
  return to;
}

/// Norms of the columns; one for a column of zeros.
VectorXd column_lengths(const Matrix& matrix) {
  VectorXd lengths(matrix.cols());
  for (Index c = 0; c < matrix.cols(); ++c) {
    const double length = matrix.col(c).norm();
    lengths[c] = length > 0 ? length : 1;
  }
  return lengths;
}

}  // namespace

VectorXd independent_shares(const Matrix& rows_transposed) {
  VectorXd shares = VectorXd::Zero(rows_transposed.cols());
  std::vector<Index> all(static_cast<std::size_t>(rows_transposed.cols()));
  std::iota(all.begin(), all.end(), Index{0});
  const Matrix scaled = scaled_columns(rows_transposed, all, pivot_order(rows_transposed, all),
                                       column_lengths(rows_transposed));
  if (scaled.rows() == 0) return shares;
  // The caller sees NaN in its result.
  if (!scaled.coeffs().allFinite()) return VectorXd::Ones(shares.size());
  Factors factors;
  factors.setPivotThreshold(kDependent);
  factors.compute(scaled);
  for (Index k = 0; k < factors.rank(); ++k)
    shares[factors.colsPermutation().indices()[k]] = std::abs(factors.matrixR().coeff(k, k));
  return shares;
}

MatrixXd free_multipliers(const Matrix& rows_transposed, const std::vector<bool>& dependent) {
  std::vector<Index> kept;
  std::vector<Index> repeated;
  for (Index k = 0; k < rows_transposed.cols(); ++k)
    (dependent[static_cast<std::size_t>(k)] ? repeated : kept).push_back(k);
  MatrixXd multipliers =
      MatrixXd::Zero(rows_transposed.cols(), static_cast<Index>(repeated.size()));
  for (std::size_t c = 0; c < repeated.size(); ++c)
    multipliers(repeated[c], static_cast<Index>(c)) = 1;
  if (repeated.empty() || kept.empty()) return multipliers;
  const VectorXd lengths = column_lengths(rows_transposed);
  Factors factors;
  factors.setPivotThreshold(0);
  const RowOrder order = pivot_order(rows_transposed, kept);
  factors.compute(scaled_columns(rows_transposed, kept, order, lengths));
  const MatrixXd right =
      scaled_columns(rows_transposed, repeated, order, VectorXd::Ones(lengths.size()));
  MatrixXd shares = factors.solve(right);
  for (Index r = 0; r < shares.rows(); ++r)
    shares.row(r) /= -lengths[kept[static_cast<std::size_t>(r)]];
  multipliers(kept, Eigen::all) = shares;
  return multipliers;
}

}  // namespace flexneck::multibody
