// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/symmetric_matrix.h"

namespace flexneck::fe_modal {

/// Cholesky factor of a subdomain, made by CHOLMOD in double and kept in single precision: half the
/// memory, which is what bounds the size of the body, and half the time of a solve, which is spent
/// on reading it. A preconditioner needs no more digits.
class SubdomainFactor {
 public:
  /// @param matrix positive definite
  /// @param node_order order of elimination, as that of CholeskyFactor
  /// @throws ComputationError if the matrix is not positive definite or memory runs out.
  SubdomainFactor(const SymmetricMatrix& matrix, std::span<const std::int32_t> node_order);

  /// Of the residuals takes the rows of some nodes, in the order of the matrix, and adds what they
  /// give there, to about seven digits of the largest one. For each column.
  void add_solution(const Eigen::MatrixXf& residuals, const std::vector<std::int32_t>& nodes,
                    Eigen::MatrixXf& result) const;
  /// Numbers that are kept.
  double nonzeros() const { return static_cast<double>(values_.size()); }

 private:
  /// Columns that have the same rows below them; a dense block of `rows` by `columns` numbers,
  /// column by column, whose first rows are the columns themselves.
  struct Supernode {
    int first = 0;  ///< column
    int columns = 0;
    int rows = 0;
    std::size_t row_list = 0;  ///< where the rows begin in rows_
    std::size_t block = 0;     ///< where the block begins in values_
  };

  void forward(Eigen::MatrixXf& x) const;
  void backward(Eigen::MatrixXf& x) const;

  std::vector<int> order_;  ///< entry k is the degree of freedom that comes k-th
  std::vector<Supernode> supernodes_;
  std::vector<int> rows_;
  std::vector<float> values_;
};

}  // namespace flexneck::fe_modal
