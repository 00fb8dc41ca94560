// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/matrix_product.h"

#include <array>

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

void add_product(double factor, const ConstColumns& a, const ConstColumns& b,
                 Eigen::Ref<Eigen::MatrixXd> result) {
  const PetscBLASInt rows = extent(a.rows());
  const PetscBLASInt columns = extent(b.cols());
  const PetscBLASInt inner = extent(a.cols());
  const std::array<PetscBLASInt, 3> strides = {extent(a.outerStride()), extent(b.outerStride()),
                                               extent(result.outerStride())};
  const double one = 1;
  if (rows == 0 || columns == 0 || inner == 0) return;
  BLASgemm_("N", "N", &rows, &columns, &inner, &factor, a.data(), &strides[0], b.data(),
            &strides[1], &one, result.data(), &strides[2]);
}

Eigen::MatrixXd inner_products(const ConstColumns& a, const ConstColumns& b) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  const PetscBLASInt rows = extent(a.cols());
  const PetscBLASInt columns = extent(b.cols());
  const PetscBLASInt inner = extent(a.rows());
  const PetscBLASInt stride_a = extent(a.outerStride());
  const PetscBLASInt stride_b = extent(b.outerStride());
  const double one = 1;
  const double zero = 0;
  if (rows == 0 || columns == 0 || inner == 0) return result;
  BLASgemm_("T", "N", &rows, &columns, &inner, &one, a.data(), &stride_a, b.data(), &stride_b,
            &zero, result.data(), &rows);
  return result;
}

}  // namespace flexneck::fe_modal
