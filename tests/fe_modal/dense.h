// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// Dense copy of a PETSc matrix, column by column through its product, which works for shell
/// matrices too.
inline Eigen::MatrixXd dense(Mat matrix) {
  PetscInt rows = 0;
  PetscInt columns = 0;
  require(MatGetSize(matrix, &rows, &columns), "asking for the size");
  Eigen::MatrixXd result(rows, columns);
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(columns);
  for (PetscInt k = 0; k < columns; ++k) {
    unit[k] = 1;
    VecHandle in;
    VecHandle out;
    require(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, columns, unit.data(), in.out()), "wrapping");
    require(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, rows, result.col(k).data(), out.out()),
            "wrapping");
    require(MatMult(matrix, in.get(), out.get()), "multiplying");
    unit[k] = 0;
  }
  return result;
}

}  // namespace flexneck::fe_modal
