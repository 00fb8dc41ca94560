// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/supernodal_factor.h"
#include "fe_modal/algebra/symmetric_matrix.h"

namespace flexneck::fe_modal {

/// Cholesky factor of a subdomain in single precision: half the memory, which is what bounds the
/// size of the body, and half the time. A preconditioner needs no more digits. Where single
/// precision finds no factor it is made in double and then rounded.
class SubdomainFactor {
 public:
  /// @param matrix positive definite
  /// @param node_order order of elimination, as that of CholeskyFactor
  /// @param threads that factorise
  /// @throws ComputationError if the matrix is not positive definite or memory runs out.
  SubdomainFactor(const SymmetricMatrix& matrix, std::span<const std::int32_t> node_order,
                  unsigned threads = 1);

  /// Of a field the rows of some nodes, which are the matrix's in its order, as the factor
  /// eliminates them.
  std::vector<Eigen::Index> rows_of(const std::vector<std::int32_t>& nodes) const;
  /// To about seven digits of the largest one, for each column of right-hand sides in that order.
  Eigen::MatrixXf solve(Eigen::MatrixXf right_hand_sides) const;
  /// Numbers that are kept.
  double nonzeros() const { return static_cast<double>(factor_.value_count()); }

 private:
  SupernodalFactor<float> factor_;
};

}  // namespace flexneck::fe_modal
