// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/constrained_modes.h"

#include <Eigen/Cholesky>

namespace flexneck::fe_modal {
namespace {

constexpr const char* kConstraining = "holding the interfaces";

}  // namespace

struct ConstrainedMass::Terms {
  Mat mass;
  Eigen::MatrixXd constraints;           ///< C^T, (dofs, n)
  Eigen::MatrixXd responses;             ///< X, (dofs, n)
  Eigen::LLT<Eigen::MatrixXd> products;  ///< of C X

  static PetscErrorCode multiply(Mat shell, Vec x, Vec y) {
    const Terms* terms = nullptr;
    PetscErrorCode code = MatShellGetContext(shell, static_cast<void*>(&terms));
    const PetscScalar* in = nullptr;
    if (code == 0) code = VecGetArrayRead(x, &in);
    if (code != 0) return code;
    const Eigen::Index size = terms->constraints.rows();
    const Eigen::Map<const Eigen::VectorXd> field(in, size);
    const Eigen::VectorXd held =
        field - terms->responses * terms->products.solve(terms->constraints.transpose() * field);
    code = VecRestoreArrayRead(x, &in);
    VecHandle projected;
    if (code == 0) {
      code = VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(size), held.data(),
                                   projected.out());
    }
    if (code == 0) code = MatMult(terms->mass, projected.get(), y);
    PetscScalar* out = nullptr;
    if (code == 0) code = VecGetArray(y, &out);
    if (code != 0) return code;
    Eigen::Map<Eigen::VectorXd> momentum(out, size);
    momentum -=
        terms->constraints * terms->products.solve(terms->responses.transpose() * momentum).eval();
    return VecRestoreArray(y, &out);
  }
};

ConstrainedMass::ConstrainedMass(Mat mass, const Eigen::MatrixXd& constraints,
                                 const Eigen::MatrixXd& responses) {
  const Eigen::MatrixXd products = constraints.transpose() * responses;
  const Eigen::MatrixXd symmetric = (products + products.transpose()) / 2;
  terms_ = std::make_shared<const Terms>(
      Terms{mass, constraints, responses, Eigen::LLT<Eigen::MatrixXd>(symmetric)});
  const auto size = static_cast<PetscInt>(constraints.rows());
  // PETSc hands the context back as it is; it is not changed through it.
  require(MatCreateShell(PETSC_COMM_SELF, size, size, size, size, const_cast<Terms*>(terms_.get()),
                         shell_.out()),
          kConstraining);
  require(MatShellSetOperation(shell_.get(), MATOP_MULT,
                               reinterpret_cast<void (*)()>(&Terms::multiply)),
          kConstraining);
  require(MatSetOption(shell_.get(), MAT_SYMMETRIC, PETSC_TRUE), kConstraining);
}

Eigen::MatrixXd ConstrainedMass::project(const Eigen::MatrixXd& columns) const {
  return columns -
         terms_->responses * terms_->products.solve(terms_->constraints.transpose() * columns);
}

}  // namespace flexneck::fe_modal
