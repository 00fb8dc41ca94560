// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/inertia.h"

#include <string>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kCounting = "counting modes by a Sturm sequence";

MatHandle indefinite_factor_of(Mat symmetric) {
  MatHandle factor;
  require(MatGetFactor(symmetric, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, factor.out()), kCounting);
  const auto set = [&](PetscInt control, PetscInt value) {
    require(MatMumpsSetIcntl(factor.get(), control, value), kCounting);
  };
  set(13, 1);    // with ScaLAPACK at the root negative pivots there would not be counted
  set(24, 1);    // detection of null pivots
  set(12, 1);    // no compressed ordering
  set(6, 0);     // no maximum transversal
  set(14, 100);  // per cent of workspace beyond the estimate, for pivoting
  return factor;
}

}  // namespace

Eigen::Index negative_eigenvalues(Mat symmetric, const Ranks& ranks) {
  // MUMPS would eliminate without pivoting in a matrix that is marked as positive definite.
  require(MatSetOption(symmetric, MAT_SPD, PETSC_FALSE), kCounting);
  require(MatSetOption(symmetric, MAT_SYMMETRIC, PETSC_TRUE), kCounting);
  const MatHandle factor = indefinite_factor_of(symmetric);
  MatFactorInfo info{};
  require(MatFactorInfoInitialize(&info), kCounting);
  require(MatCholeskyFactorSymbolic(factor.get(), symmetric, nullptr, &info), kCounting);
  constexpr PetscInt kMegabytesOfLargest = 16;
  require_memory(kCounting,
                 1e6 * ranks.on_this_machine() * infog(factor.get(), kMegabytesOfLargest),
                 "use a coarser mesh, or omit the check");
  require(MatCholeskyFactorNumeric(factor.get(), symmetric, &info), kCounting);
  const PetscInt status = infog(factor.get(), 1);
  if (status < 0)
    throw ComputationError(
        "MUMPS failed while " + std::string(kCounting) + ": INFOG(1) = " + std::to_string(status) +
        ", INFOG(2) = " + std::to_string(infog(factor.get(), 2)) + "; omit the check");
  constexpr PetscInt kNullPivots = 28;
  if (infog(factor.get(), kNullPivots) > 0)
    throw ComputationError(
        "an eigenvalue coincides with the shift of the Sturm sequence check; use another shift");
  PetscInt negative = 0;
  PetscInt zero = 0;
  PetscInt positive = 0;
  require(MatGetInertia(factor.get(), &negative, &zero, &positive), kCounting);
  return negative;
}

}  // namespace flexneck::fe_modal
