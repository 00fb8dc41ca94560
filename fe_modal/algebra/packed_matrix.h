// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/register_row.h"

namespace flexneck::fe_modal {

/// A small dense matrix, laid out once for many products with rows of eight columns. A BLAS would
/// lay out both factors for each product, which with the table of an element's shape functions
/// takes as long as the product.
class PackedMatrix {
 public:
  explicit PackedMatrix(const Eigen::MatrixXd& matrix);

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }

  /// y = matrix x.
  /// @param x (columns, groups), row by row: eight columns a group
  /// @param y (rows, groups) likewise; may not overlap x
  void multiply(const RowOf<double>* x, std::size_t groups, RowOf<double>* y,
                VectorRegisters registers = widest_registers()) const;
  /// All entries in the order that they are laid out in.
  std::span<double> entries() { return {values_.front().value, rows_ * columns_}; }

 private:
  std::size_t rows_;
  std::size_t columns_;
  /// Up to three rows at a time, column by column; zeros behind.
  std::vector<RowOf<double>> values_;
};

}  // namespace flexneck::fe_modal
