// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/supernodes.h"
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

  /// Of a field the rows of some nodes, which are the matrix's in its order, as the factor
  /// eliminates them.
  std::vector<Eigen::Index> rows_of(const std::vector<std::int32_t>& nodes) const;
  /// To about seven digits of the largest one, for each column of right-hand sides in that order.
  Eigen::MatrixXf solve(Eigen::MatrixXf right_hand_sides) const;
  /// Numbers that are kept.
  double nonzeros() const { return static_cast<double>(values_.size()); }

 private:
  Supernodes supernodes_;
  std::vector<float> values_;
};

}  // namespace flexneck::fe_modal
