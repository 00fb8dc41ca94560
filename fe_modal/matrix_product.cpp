// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/matrix_product.h"

#include "fe_modal/petsc_handles.h"

// After a header of PETSc: it does not include what it needs.
#include <petscblaslapack.h>

namespace flexneck::fe_modal {
namespace {

PetscBLASInt extent(Eigen::Index n) { return static_cast<PetscBLASInt>(n); }

}  // namespace

void multiply_by_transpose(double factor, const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                           double keep, Eigen::MatrixXd& result) {
  const PetscBLASInt rows = extent(a.rows());
  const PetscBLASInt columns = extent(b.rows());
  const PetscBLASInt inner = extent(a.cols());
  BLASgemm_("N", "T", &rows, &columns, &inner, &factor, a.data(), &rows, b.data(), &columns, &keep,
            result.data(), &rows);
}

void multiply(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, Eigen::MatrixXd& result) {
  const PetscBLASInt rows = extent(a.rows());
  const PetscBLASInt columns = extent(b.cols());
  const PetscBLASInt inner = extent(a.cols());
  const double one = 1;
  const double zero = 0;
  BLASgemm_("N", "N", &rows, &columns, &inner, &one, a.data(), &rows, b.data(), &inner, &zero,
            result.data(), &rows);
}

}  // namespace flexneck::fe_modal
