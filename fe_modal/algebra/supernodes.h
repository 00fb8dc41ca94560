// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cholmod.h>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// The places of the entries of a supernodal Cholesky factor, P A P^T = L L^T, and the triangular
/// solves with it, eight columns at a time: the factor, which no cache holds, is read once for
/// eight columns. A BLAS packs it first, which here takes as long as the product.
class Supernodes {
 public:
  Supernodes() = default;
  /// @param factor may go afterwards
  explicit Supernodes(const cholmod_factor& factor);

  /// Entry k is the row of A that comes k-th.
  std::span<const int> order() const { return order_; }
  /// x = (L L^T)^-1 x.
  /// @param values of the factor, as CHOLMOD stores them
  /// @param x (n, k), rows in the order of elimination
  void solve(std::span<const double> values, Eigen::MatrixXd& x) const;
  void solve(std::span<const float> values, Eigen::MatrixXf& x) const;

  /// Columns that have the same rows below them; a dense block of `rows` by `columns` numbers,
  /// column by column, whose first rows are the columns themselves.
  struct Supernode {
    int first = 0;  ///< column
    int columns = 0;
    int rows = 0;
    std::size_t row_list = 0;  ///< where the rows begin in the list of all
    std::size_t block = 0;     ///< where the block begins in the values
  };

 private:
  std::vector<int> order_;
  std::vector<Supernode> supernodes_;
  std::vector<int> rows_;
};

}  // namespace flexneck::fe_modal
