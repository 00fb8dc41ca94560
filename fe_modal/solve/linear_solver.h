// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>

#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/system/modal_system.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

/// Error of a matrix that is not positive definite.
class NotDefinite : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

/// Operator (K - shift M)^-1 by PETSc's KSP with the Cholesky factor of CHOLMOD or MUMPS. Vectors
/// are this rank's rows; all members except simple accessors are collective.
class LinearSolver {
 public:
  /// Factorises. CHOLMOD eliminates the rows in their order (elimination_order.h) and uses one
  /// process; MUMPS finds an order of its own.
  /// @param shifted_stiffness K - shift M, symmetric, marked as positive definite; stays alive
  /// @throws NotDefinite if it is not positive definite.
  /// @throws OutOfMemory before the numeric factorisation if memory does not hold the factor.
  /// @throws ComputationError if the factorisation fails for another reason.
  LinearSolver(Mat shifted_stiffness, double shift, const Ranks& ranks = {},
               Solver solver = Solver::automatic);

  double shift() const { return shift_; }
  const Ranks& ranks() const { return ranks_; }
  Mat matrix() const { return matrix_.get(); }
  /// Solver for an EPS, which must be given another one before it is destroyed: it resets its own.
  KSP ksp() const { return ksp_.get(); }
  /// True if a user has chosen a method that iterates with the factor, and may end early.
  bool iterates() const;
  /// Number of entries of the factor.
  double nonzeros() const { return nonzeros_; }
  /// Solves for each column, (own dofs, k).
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_sides) const;
  /// Text of the factor and the number of calls of MatSolve and MatMatSolve: "CHOLMOD: the factor
  /// has 12.3 million entries; 34 solves, 5 of blocks".
  std::string describe() const;

 private:
  void set_up(int mumps_workspace_percent);
  void check_memory() const;
  void factorise();
  Mat factor() const;

  MatHandle matrix_;
  double shift_;
  Ranks ranks_;
  Solver solver_;
  KspHandle ksp_;
  double nonzeros_ = 0;
  mutable int block_solves_ = 0;
};

/// Factorises K - shift M of a system.
std::unique_ptr<LinearSolver> shift_inverse(const ModalSystem& system, double shift);

}  // namespace flexneck::fe_modal
