// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/block_elimination.h"

namespace flexneck::fe_modal {

/// Cholesky factor of a small matrix, made in double and kept in single precision: panels of a few
/// columns from their diagonal down, in hardly more memory than its lower half takes.
class PanelFactor {
 public:
  PanelFactor() = default;
  /// @param matrix lower half; is overwritten
  /// @throws ComputationError if it is not positive definite.
  explicit PanelFactor(Eigen::MatrixXd& matrix);

  /// x = (L L^T)^-1 x, as many rows as the matrix, of 8 or 16 columns.
  template <std::size_t lanes>
  void solve(RowOf<float, lanes>* x) const;

 private:
  /// @param first column
  FactorBlock<float> panel_at(const float* values, int first) const;

  int size_ = 0;
  std::vector<float> values_;
};

}  // namespace flexneck::fe_modal
