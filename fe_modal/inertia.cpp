// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/inertia.h"

#include "fe_modal/petsc_handles.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kCounting = "counting eigenvalues by inertia";

}  // namespace

Eigen::Index eigenvalues_below(const SystemMatrices& system, double sigma) {
  const SymmetricMatrix shifted = shifted_stiffness(system, sigma);
  // Not positive definite: MUMPS takes the label at its word.
  require(MatSetOption(shifted.get(), MAT_SPD, PETSC_FALSE), kCounting);
  require(MatSetOption(shifted.get(), MAT_SYMMETRIC, PETSC_TRUE), kCounting);
  MatHandle factor;
  require(MatGetFactor(shifted.get(), MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor.out()),
          kCounting);
  constexpr PetscInt kSequentialRoot = 13;
  constexpr PetscInt kFindNullPivots = 24;
  require(MatMumpsSetIcntl(factor.get(), kSequentialRoot, 1), kCounting);
  require(MatMumpsSetIcntl(factor.get(), kFindNullPivots, 1), kCounting);
  MatFactorInfo settings;
  require(MatFactorInfoInitialize(&settings), kCounting);
  require(MatCholeskyFactorSymbolic(factor.get(), shifted.get(), nullptr, &settings), kCounting);
  require(MatCholeskyFactorNumeric(factor.get(), shifted.get(), &settings), kCounting);
  PetscInt negative = 0;
  PetscInt zero = 0;
  require(MatGetInertia(factor.get(), &negative, &zero, nullptr), kCounting);
  if (zero > 0) {
    throw ComputationError("an eigenvalue lies where the inertia was to be taken; take another");
  }
  return negative;
}

}  // namespace flexneck::fe_modal
