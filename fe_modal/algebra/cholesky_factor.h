// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <Eigen/Core>

#include "fe_modal/algebra/cholmod_order.h"
#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/algebra/pivots.h"
#include "fe_modal/algebra/shift_inverse.h"
#include "fe_modal/algebra/supernodal_factor.h"

namespace flexneck::fe_modal {

/// An entry of a Cholesky factor takes this, with the zeros in its blocks and what its making
/// needs besides; in single precision half of it.
inline constexpr double kBytesPerFactorEntry = 8.6;
inline constexpr double kBytesPerSingleEntry = kBytesPerFactorEntry / 2;

/// Of an entry on the diagonal: of a singular matrix rounding errors leave up to 1e-13 for a pivot,
/// sound bodies hardly ever so little.
inline constexpr double kSingularPivot = 1e-10;

/// "the factor has 12.3 million entries"
std::string entries_text(double nonzeros);

/// @throws InputError if memory does not hold a factor of so many entries.
void require_memory_for_factor(double nonzeros, double bytes_per_entry);

/// Sparse Cholesky factor of K - shift M, made once and used by every solve; CHOLMOD finds the
/// places of its entries.
class CholeskyFactor : public ShiftInverse {
 public:
  /// @param shifted_stiffness K - shift M, symmetric with the upper half stored by scalar rows, N
  /// degrees of freedom
  /// @param node_order order of elimination: entry k is the node, three degrees of freedom each,
  /// that comes k-th; a permutation of 0 … N/3 - 1. Empty: CHOLMOD tries AMD, and METIS on all
  /// degrees of freedom where AMD fills much, and keeps the better one.
  /// @param threads that factorise, where the BLAS may be called by several at once, and solve
  /// @throws InputError if memory does not hold the factor, before it is made, or its entries are
  /// more than CHOLMOD's integers count.
  /// @throws ComputationError if the matrix is not positive definite or memory runs out.
  CholeskyFactor(Mat shifted_stiffness, double shift, std::span<const std::int32_t> node_order = {},
                 unsigned threads = 1);
  /// The same by a kind of order, with node_order where one is given. A matrix that is numbered in
  /// the order of its elimination, a postorder (fe_modal/system/elimination_order.h), is not
  /// copied: a sixth of the factor's size.
  CholeskyFactor(Mat shifted_stiffness, double shift, CholmodOrder kind,
                 std::span<const std::int32_t> node_order, unsigned threads = 1);
  /// Of a matrix that has been analysed.
  CholeskyFactor(CholmodAnalysis& analysis, double shift, unsigned threads);

  /// Entries of the factor, as CHOLMOD counts them.
  double nonzeros() const { return nonzeros_; }
  /// For each column, all at once: the factor, which no cache holds, is read once for many.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const override;
  bool is_doubtful() const override;
  std::string describe() const override;

 private:
  void factorise(CholmodAnalysis& analysis);

  double nonzeros_ = 0;
  unsigned threads_;
  SupernodalFactor<double> factor_;
};

}  // namespace flexneck::fe_modal
