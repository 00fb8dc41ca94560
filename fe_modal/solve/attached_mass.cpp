// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/attached_mass.h"

#include <Eigen/Eigenvalues>

namespace flexneck::fe_modal {

AttachedMass::AttachedMass(const Ranks& ranks, Mat mass, const Eigen::MatrixXd& loads,
                           const Matrix6d& rigid_mass) {
  constexpr const char* kAttaching = "attaching a rigid body";
  const Eigen::SelfAdjointEigenSolver<Matrix6d> principal(rigid_mass);
  principal_loads_ = loads * principal.eigenvectors();
  columns_ = dense_on(principal_loads_, ranks);
  require(VecCreateSeq(PETSC_COMM_SELF, 6, diagonal_.out()), kAttaching);
  for (PetscInt k = 0; k < 6; ++k)
    require(VecSetValue(diagonal_.get(), k, principal.eigenvalues()[k], INSERT_VALUES), kAttaching);
  require(VecAssemblyBegin(diagonal_.get()), kAttaching);
  require(VecAssemblyEnd(diagonal_.get()), kAttaching);
  require(MatCreateLRC(mass, columns_.get(), diagonal_.get(), columns_.get(), sum_.out()),
          kAttaching);
  require(MatSetOption(sum_.get(), MAT_SYMMETRIC, PETSC_TRUE), kAttaching);
}

}  // namespace flexneck::fe_modal
