// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/matrix_product.h"

#include <algorithm>

#include "fe_modal/algebra/petsc_handles.h"

// This header follows one of PETSc, since it does not include what it needs.
#include <petscblaslapack.h>

namespace flexneck::fe_modal {
namespace {

/// Step between columns: the BLAS requires at least one row, even of a matrix without rows.
PetscBLASInt stride(const MatrixView& matrix) {
  return static_cast<PetscBLASInt>(std::max<Eigen::Index>(1, matrix.outerStride()));
}

void product(const char* turn_a, const char* turn_b, Eigen::Index inner, double factor,
             const MatrixView& a, const MatrixView& b, double keep,
             Eigen::Ref<Eigen::MatrixXd> result) {
  const auto rows = static_cast<PetscBLASInt>(result.rows());
  const auto columns = static_cast<PetscBLASInt>(result.cols());
  const auto depth = static_cast<PetscBLASInt>(inner);
  const PetscBLASInt stride_a = stride(a);
  const PetscBLASInt stride_b = stride(b);
  const PetscBLASInt stride_result = stride(result);
  BLASgemm_(turn_a, turn_b, &rows, &columns, &depth, &factor, a.data(), &stride_a, b.data(),
            &stride_b, &keep, result.data(), &stride_result);
}

}  // namespace

void multiply(double factor, const MatrixView& a, const MatrixView& b, double keep,
              Eigen::Ref<Eigen::MatrixXd> result) {
  product("N", "N", a.cols(), factor, a, b, keep, result);
}

void multiply_by_transpose(double factor, const MatrixView& a, const MatrixView& b, double keep,
                           Eigen::Ref<Eigen::MatrixXd> result) {
  product("N", "T", a.cols(), factor, a, b, keep, result);
}

void multiply_transpose(double factor, const MatrixView& a, const MatrixView& b, double keep,
                        Eigen::Ref<Eigen::MatrixXd> result) {
  product("T", "N", a.rows(), factor, a, b, keep, result);
}

Eigen::MatrixXd inner_products(const Ranks& ranks, const MatrixView& a, const MatrixView& b) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(a.cols(), b.cols());
  product("T", "N", a.rows(), 1, a, b, 0, result);
  ranks.sum(result);
  return result;
}

Eigen::VectorXd column_products(const Ranks& ranks, const MatrixView& a, const MatrixView& b) {
  Eigen::MatrixXd result = a.cwiseProduct(b).colwise().sum().transpose();
  ranks.sum(result);
  return result;
}

}  // namespace flexneck::fe_modal
