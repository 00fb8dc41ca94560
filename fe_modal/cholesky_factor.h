// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/petsc_handles.h"

namespace flexneck::fe_modal {

/// Sparse Cholesky factor of K - shift M, made once and used by every solve. By CHOLMOD with a
/// METIS ordering: on the default neck it takes two thirds of MUMPS's time, for want of METIS
/// there.
class CholeskyFactor {
 public:
  /// @param stiffness symmetric, both halves stored
  /// @param mass its entries lie where the stiffness has some
  /// @throws ComputationError if K - shift M is not positive definite or memory runs out.
  CholeskyFactor(Mat stiffness, Mat mass, double shift);

  double shift() const { return shift_; }
  void solve(Vec right_hand_side, Vec solution) const;

 private:
  double shift_;
  MatHandle factor_;
};

}  // namespace flexneck::fe_modal
