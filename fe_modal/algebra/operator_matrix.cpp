// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/operator_matrix.h"

#include <exception>
#include <utility>

#include "fe_modal/algebra/communicator.h"
#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

namespace {

/// Carries an exception past the C frames of PETSc and SLEPc, which it must not cross: the function
/// that they call keeps it and returns an error code, and the caller of PETSc throws it again.
class KeptException {
 public:
  /// Runs the work of a function that PETSc calls.
  /// @return 0, or an error code if `work` has thrown
  template <typename Work>
  PetscErrorCode keep(Work&& work) noexcept {
    try {
      std::forward<Work>(work)();
      return 0;
    } catch (...) {
      kept_ = std::current_exception();
      return PETSC_ERR_LIB;
    }
  }

  /// Throws the kept exception, once; for use after a call of PETSc.
  void rethrow() {
    if (kept_) std::rethrow_exception(std::exchange(kept_, nullptr));
  }

 private:
  std::exception_ptr kept_;
};

}  // namespace

/// Data that a PETSc shell matrix points to.
struct OperatorMatrix::Context {
  BlockOperator apply;
  KeptException failure;
};

namespace {

constexpr const char* kMaking = "creating the matrix of an operator";
constexpr const char* kUsing = "applying the matrix of an operator";

/// Function that PETSc calls for y = A x.
PetscErrorCode multiply(Mat shell, Vec x, Vec y) {
  OperatorMatrix::Context* context = nullptr;
  PetscInt size = 0;
  const PetscScalar* in = nullptr;
  PetscScalar* out = nullptr;
  PetscErrorCode code = MatShellGetContext(shell, static_cast<void*>(&context));
  if (code == 0) code = VecGetLocalSize(x, &size);
  if (code == 0) code = VecGetArrayRead(x, &in);
  if (code == 0) code = VecGetArray(y, &out);
  if (code != 0) return code;
  code = context->failure.keep([&] {
    Eigen::Map<Eigen::MatrixXd>(out, size, 1) =
        context->apply(Eigen::Map<const Eigen::MatrixXd>(in, size, 1));
  });
  const PetscErrorCode restored = VecRestoreArray(y, &out);
  if (code == 0) code = restored;
  return code != 0 ? code : VecRestoreArrayRead(x, &in);
}

/// Context of a shell matrix; null for other matrices.
OperatorMatrix::Context* context_of(Mat matrix) {
  PetscBool is_shell = PETSC_FALSE;
  OperatorMatrix::Context* context = nullptr;
  require(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(matrix), MATSHELL, &is_shell),
          kUsing);
  if (is_shell == PETSC_TRUE) {
    require(MatShellGetContext(matrix, static_cast<void*>(&context)), kUsing);
  }
  return context;
}

}  // namespace

OperatorMatrix::OperatorMatrix(Eigen::Index own_size, BlockOperator apply, const Ranks& ranks)
    : context_(std::make_unique<Context>(Context{std::move(apply), {}})) {
  const auto n = static_cast<PetscInt>(own_size);
  require(MatCreateShell(communicator(ranks), n, n, PETSC_DETERMINE, PETSC_DETERMINE,
                         context_.get(), shell_.out()),
          kMaking);
  require(MatShellSetOperation(shell_.get(), MATOP_MULT, reinterpret_cast<void (*)()>(&multiply)),
          kMaking);
  require(MatSetOption(shell_.get(), MAT_SYMMETRIC, PETSC_TRUE), kMaking);
}

OperatorMatrix::~OperatorMatrix() = default;
OperatorMatrix::OperatorMatrix(OperatorMatrix&& other) noexcept = default;
OperatorMatrix& OperatorMatrix::operator=(OperatorMatrix&& other) noexcept = default;

const BlockOperator* operator_behind(Mat matrix) {
  const OperatorMatrix::Context* const context = context_of(matrix);
  return context == nullptr ? nullptr : &context->apply;
}

void rethrow_from(Mat matrix) {
  if (OperatorMatrix::Context* const context = context_of(matrix)) context->failure.rethrow();
}

}  // namespace flexneck::fe_modal
