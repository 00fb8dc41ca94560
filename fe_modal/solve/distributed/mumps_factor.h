// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <mpi.h>

#include "fe_modal/algebra/symmetric_matrix.h"

namespace flexneck::fe_modal {

/// LDL^T of a symmetric matrix whose parts lie on the ranks of a communicator, by MUMPS's own
/// interface: PETSc's takes no order of elimination, and Debian's MUMPS has no METIS.
///
/// Every member is collective. A failure is a ComputationError on every rank.
class MumpsFactor {
 public:
  enum class Kind {
    definite,   ///< no pivoting; fails on a pivot that is not positive
    indefinite  ///< with pivoting, counts negative pivots
  };

  /// @param part of the matrix, which adds to those of the other ranks
  /// @param nodes (nodes of the part) their numbers in the whole matrix, ascending
  /// @param node_order on rank 0: order of elimination of all nodes, three degrees of freedom each
  MumpsFactor(MPI_Comm ranks, Kind kind, SymmetricMatrix& part, std::span<const std::int32_t> nodes,
              std::span<const std::int32_t> node_order);
  ~MumpsFactor();
  MumpsFactor(const MumpsFactor&) = delete;
  MumpsFactor& operator=(const MumpsFactor&) = delete;

  /// @param values on rank 0: right-hand sides, (N, columns) by columns, replaced by solutions
  void solve(double* values, int columns) const;

  int negative_pivots() const;
  double nonzeros() const;  ///< of the factor, on all ranks together

 private:
  struct Instance;
  std::unique_ptr<Instance> instance_;
};

}  // namespace flexneck::fe_modal
