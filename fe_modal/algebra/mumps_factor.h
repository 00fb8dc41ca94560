// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "fe_modal/algebra/dof_layout.h"
#include "fe_modal/algebra/symmetric_matrix.h"

namespace flexneck::fe_modal {

/// LDL^T of a symmetric matrix whose parts lie on the ranks, by MUMPS's own interface: PETSc's
/// takes no order of elimination, and Debian's MUMPS has no METIS.
///
/// Every member is collective. A failure is a ComputationError on every rank, an InputError if
/// memory does not hold the factor.
class MumpsFactor {
 public:
  enum class Kind {
    definite,   ///< no pivoting; fails on a pivot that is not positive
    indefinite  ///< with pivoting, counts negative pivots
  };

  /// @param layout of the rows; must outlive this
  /// @param part of the matrix, which adds to those of the other ranks
  /// @param blocks (rows of the part / 3) their numbers in the whole matrix, ascending
  /// @param order on the first rank: of elimination of all blocks
  MumpsFactor(const DofLayout& layout, Kind kind, SymmetricMatrix& part,
              std::span<const std::int32_t> blocks, std::span<const std::int32_t> order);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  /// For each column, (own dofs, k).
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const;

  int negative_pivots() const;
  double nonzeros() const;  ///< of the factor, on all ranks together

 private:
  struct Instance;
  std::unique_ptr<Instance> instance_;
};

}  // namespace flexneck::fe_modal
