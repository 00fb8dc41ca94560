// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/operator_matrix.h"

#include <exception>
#include <utility>

namespace flexneck::fe_modal {
namespace {

/// What PETSc calls for y = A x.
PetscErrorCode multiply(Mat shell, Vec x, Vec y) {
  const BlockOperator* apply = nullptr;
  PetscInt size = 0;
  const PetscScalar* in = nullptr;
  PetscScalar* out = nullptr;
  PetscErrorCode code = MatShellGetContext(shell, static_cast<void*>(&apply));
  if (code == 0) code = VecGetSize(x, &size);
  if (code == 0) code = VecGetArrayRead(x, &in);
  if (code == 0) code = VecGetArray(y, &out);
  if (code != 0) return code;
  try {
    Eigen::Map<Eigen::MatrixXd>(out, size, 1) =
        (*apply)(Eigen::Map<const Eigen::MatrixXd>(in, size, 1));
  } catch (const std::exception&) {
    return PETSC_ERR_LIB;  // no exception may cross PETSc
  }
  code = VecRestoreArray(y, &out);
  return code != 0 ? code : VecRestoreArrayRead(x, &in);
}

}  // namespace

OperatorMatrix::OperatorMatrix(Eigen::Index size, BlockOperator apply)
    : apply_(std::make_unique<const BlockOperator>(std::move(apply))) {
  constexpr const char* kMaking = "making a matrix of an operator";
  const auto n = static_cast<PetscInt>(size);
  // PETSc hands the context back as it is; the operator is not changed through it.
  require(MatCreateShell(PETSC_COMM_SELF, n, n, n, n, const_cast<BlockOperator*>(apply_.get()),
                         shell_.out()),
          kMaking);
  require(MatShellSetOperation(shell_.get(), MATOP_MULT, reinterpret_cast<void (*)()>(&multiply)),
          kMaking);
  require(MatSetOption(shell_.get(), MAT_SYMMETRIC, PETSC_TRUE), kMaking);
}

}  // namespace flexneck::fe_modal
