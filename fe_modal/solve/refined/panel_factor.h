// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/block_elimination.h"

namespace flexneck::fe_modal {

/// Cholesky factor of a small matrix, made in double and kept in 16 bits an entry below the
/// diagonal, which is kept in single precision; panels of a few columns are unpacked for solutions.
/// Entries are rounded to a 65534th of the largest of their column, which a preconditioner may: the
/// product of the factor with its transpose stays positive definite.
class PanelFactor {
 public:
  /// Allocates what the factor takes, of as many rows.
  explicit PanelFactor(std::size_t size);

  /// @param matrix lower half; is overwritten
  /// @throws ComputationError if it is not positive definite.
  void factorise(Eigen::MatrixXd& matrix);

  /// The panels, for solve(); of zeros above the diagonal.
  void unpack(std::vector<float>& entries) const;
  /// x = (L L^T)^-1 x, as many rows as the matrix, of 8 or 16 columns.
  template <std::size_t lanes>
  void solve(std::span<const float> entries, RowOf<float, lanes>* x) const;

 private:
  /// @param first column
  FactorBlock<float> panel_at(const float* values, int first) const;

  int size_;
  std::vector<float> diagonal_;
  std::vector<float> steps_;          ///< what 1 stands for in each column
  std::vector<std::int16_t> values_;  ///< below the diagonal, column by column
};

}  // namespace flexneck::fe_modal
