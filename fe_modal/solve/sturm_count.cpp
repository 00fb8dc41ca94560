// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/sturm_count.h"

#include "fe_modal/algebra/petsc_handles.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kCounting = "counting eigenvalues by inertia";

}  // namespace

Eigen::Index negative_eigenvalues(Mat shifted) {
  // Not positive definite: MUMPS takes the label at its word.
  require(MatSetOption(shifted, MAT_SPD, PETSC_FALSE), kCounting);
  require(MatSetOption(shifted, MAT_SYMMETRIC, PETSC_TRUE), kCounting);
  MatHandle factor;
  require(MatGetFactor(shifted, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor.out()), kCounting);
  constexpr PetscInt kSequentialRoot = 13;
  constexpr PetscInt kFindNullPivots = 24;
  require(MatMumpsSetIcntl(factor.get(), kSequentialRoot, 1), kCounting);
  require(MatMumpsSetIcntl(factor.get(), kFindNullPivots, 1), kCounting);
  MatFactorInfo settings;
  require(MatFactorInfoInitialize(&settings), kCounting);
  require(MatCholeskyFactorSymbolic(factor.get(), shifted, nullptr, &settings), kCounting);
  constexpr PetscInt kMegabytes = 17;
  PetscInt megabytes = 0;
  require(MatMumpsGetInfog(factor.get(), kMegabytes, &megabytes), kCounting);
  require_memory("counting modes by inertia", 1e6 * megabytes,
                 "take a coarser mesh, or leave out modes.certify");
  require(MatCholeskyFactorNumeric(factor.get(), shifted, &settings), kCounting);
  PetscInt negative = 0;
  PetscInt zero = 0;
  require(MatGetInertia(factor.get(), &negative, &zero, nullptr), kCounting);
  if (zero > 0) {
    throw ComputationError("an eigenvalue lies where the inertia was to be taken; take another");
  }
  return negative;
}

}  // namespace flexneck::fe_modal
