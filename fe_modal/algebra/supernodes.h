// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

struct cholmod_factor_struct;  // of CHOLMOD, whose header stays in the .cpp files

namespace flexneck::fe_modal {

/// The places of the entries of a supernodal Cholesky factor, P A P^T = L L^T, and the solves with
/// it.
class Supernodes {
 public:
  Supernodes() = default;
  /// @param factor may go afterwards
  explicit Supernodes(const cholmod_factor_struct& factor);

  /// Entry k is the row of A that comes k-th.
  std::span<const int> order() const { return order_; }
  /// x = (L L^T)^-1 x, the same to the last bit by any number of threads.
  /// @param values of the factor, as CHOLMOD stores them
  /// @param x (n, k), rows in the order of elimination
  void solve(std::span<const double> values, Eigen::MatrixXd& x, unsigned threads) const;
  void solve(std::span<const float> values, Eigen::MatrixXf& x, unsigned threads) const;

 private:
  /// Columns that have the same rows below them; a dense block of `rows` by `columns` numbers,
  /// column by column, whose first rows are the columns themselves.
  struct Supernode {
    int first = 0;  ///< column
    int columns = 0;
    int rows = 0;
    std::size_t row_list = 0;  ///< where the rows begin in the list of all
    std::size_t block = 0;     ///< where the block begins in the values

    int end() const { return first + columns; }
  };
  /// A supernode with all below it in the elimination tree, which have neighbouring numbers. In the
  /// row lists of a subtree, row end_row + k stands for row ancestors[k] of the factor.
  struct Subtree {
    std::size_t begin = 0;  ///< supernodes
    std::size_t end = 0;
    int end_row = 0;
    std::vector<int> ancestors;  ///< rows above it in the tree that it updates, ascending
  };
  template <typename Scalar>
  class Solve;
  template <typename Scalar, typename Matrix>
  void solve_by_eight(std::span<const Scalar> values, Matrix& x, unsigned threads) const;

  /// Divides the elimination tree into subtrees and its top.
  void find_subtrees();
  void number_ancestor_rows();
  const int* rows_of(const Supernode& node) const { return rows_.data() + node.row_list; }

  std::vector<int> order_;
  std::vector<Supernode> supernodes_;
  std::vector<int> rows_;
  int max_rows_ = 0;               ///< of a block
  std::vector<Subtree> subtrees_;  ///< independent of one another, ascending
  std::vector<std::size_t> top_;   ///< all other supernodes, ascending
};

}  // namespace flexneck::fe_modal
