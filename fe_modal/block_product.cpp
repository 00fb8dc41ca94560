// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/block_product.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kMultiplying = "multiplying with a matrix";

/// A vector of PETSc's on a column, which outlives it.
VecHandle wrap(const double* column, Eigen::Index size) {
  VecHandle vector;
  require(
      VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(size), column, vector.out()),
      kMultiplying);
  return vector;
}

}  // namespace

Eigen::MatrixXd block_product(Mat matrix, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const VecHandle in = wrap(columns.col(k).data(), columns.rows());
    const VecHandle out = wrap(result.col(k).data(), columns.rows());
    require(MatMult(matrix, in.get(), out.get()), kMultiplying);
  }
  return result;
}

}  // namespace flexneck::fe_modal
