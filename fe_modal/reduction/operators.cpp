// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/operators.h"

namespace flexneck::fe_modal {
namespace {

VecHandle wrap(const double* values, Eigen::Index size) {
  VecHandle vector;
  require(
      VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(size), values, vector.out()),
      "wrapping a vector");
  return vector;
}

Eigen::MatrixXd multiply_columns(Mat matrix, const Eigen::MatrixXd& in) {
  Eigen::MatrixXd out(in.rows(), in.cols());
  for (Eigen::Index k = 0; k < in.cols(); ++k) {
    const VecHandle x = wrap(in.col(k).data(), in.rows());
    const VecHandle y = wrap(out.col(k).data(), out.rows());
    require(MatMult(matrix, x.get(), y.get()), "multiplying with a system matrix");
  }
  return out;
}

}  // namespace

BodyOperators operators_of(const ModalSystem& system, const ShiftInverse& inverse) {
  const auto multiply_by = [](Mat matrix) {
    return [matrix](const Eigen::MatrixXd& in) { return multiply_columns(matrix, in); };
  };
  return {multiply_by(system.stiffness()), multiply_by(system.mass()),
          [&inverse](const Eigen::MatrixXd& loads) { return inverse.solve(loads); },
          inverse.shift()};
}

}  // namespace flexneck::fe_modal
