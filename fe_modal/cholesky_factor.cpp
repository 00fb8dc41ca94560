// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/cholesky_factor.h"

#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kFactorising = "factorising the stiffness matrix";

MatHandle factorise(Mat matrix) {
  MatHandle factor;
  require(MatGetFactor(matrix, MATSOLVERCHOLMOD, MAT_FACTOR_CHOLESKY, factor.out()), kFactorising);
  MatFactorInfo info;
  require(MatFactorInfoInitialize(&info), kFactorising);
  // No ordering of PETSc's: CHOLMOD chooses its own.
  require(MatCholeskyFactorSymbolic(factor.get(), matrix, nullptr, &info), kFactorising);
  require(MatCholeskyFactorNumeric(factor.get(), matrix, &info), kFactorising);
  MatFactorError error = MAT_FACTOR_NOERROR;
  require(MatFactorGetError(factor.get(), &error), kFactorising);
  if (error != MAT_FACTOR_NOERROR) {
    throw ComputationError(
        "the stiffness matrix is not positive definite: a part of the body is not held");
  }
  return factor;
}

}  // namespace

CholeskyFactor::CholeskyFactor(Mat stiffness, Mat mass, double shift) : shift_(shift) {
  if (shift == 0) {
    factor_ = factorise(stiffness);
    return;
  }
  MatHandle shifted;
  require(MatDuplicate(stiffness, MAT_COPY_VALUES, shifted.out()), kFactorising);
  require(MatAXPY(shifted.get(), -shift, mass, SUBSET_NONZERO_PATTERN), kFactorising);
  require(MatSetOption(shifted.get(), MAT_SPD, PETSC_TRUE), kFactorising);
  factor_ = factorise(shifted.get());
}

void CholeskyFactor::solve(Vec right_hand_side, Vec solution) const {
  require(MatSolve(factor_.get(), right_hand_side, solution), "solving with the factor");
}

}  // namespace flexneck::fe_modal
