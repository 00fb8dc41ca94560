// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/independent_rows.h"

#include <algorithm>

#include <Eigen/QR>

namespace flexneck::multibody {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDependent = 3e-6;

}  // namespace

std::vector<bool> dependent_rows(const MatrixXd& rows_transposed) {
  const Index count = rows_transposed.cols();
  // Gram and Schmidt's method, each row made orthogonal twice against rounding.
  MatrixXd basis(rows_transposed.rows(), std::min(rows_transposed.rows(), count));
  Index rank = 0;
  std::vector<bool> dependent(static_cast<std::size_t>(count), true);
  for (Index k = 0; k < count && rank < basis.cols(); ++k) {
    VectorXd left = rows_transposed.col(k);
    const double length = left.norm();
    for (int pass = 0; pass < 2; ++pass) {
      const VectorXd shares = basis.leftCols(rank).transpose() * left;
      left.noalias() -= basis.leftCols(rank) * shares;
    }
    if (left.norm() <= kDependent * length) continue;
    dependent[static_cast<std::size_t>(k)] = false;
    basis.col(rank++) = left.normalized();
  }
  return dependent;
}

MatrixXd free_multipliers(const MatrixXd& rows_transposed, const std::vector<bool>& dependent) {
  std::vector<Index> kept;
  std::vector<Index> repeated;
  for (Index k = 0; k < rows_transposed.cols(); ++k)
    (dependent[static_cast<std::size_t>(k)] ? repeated : kept).push_back(k);
  MatrixXd multipliers =
      MatrixXd::Zero(rows_transposed.cols(), static_cast<Index>(repeated.size()));
  if (repeated.empty()) return multipliers;
  const Eigen::ColPivHouseholderQR<MatrixXd> factors(rows_transposed(Eigen::all, kept));
  multipliers(kept, Eigen::all) = -factors.solve(rows_transposed(Eigen::all, repeated));
  for (std::size_t c = 0; c < repeated.size(); ++c)
    multipliers(repeated[c], static_cast<Index>(c)) = 1;
  return multipliers;
}

}  // namespace flexneck::multibody
