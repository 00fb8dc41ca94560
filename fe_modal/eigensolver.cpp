// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/eigensolver.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "fe_modal/block_lanczos.h"
#include "fe_modal/matrix_product.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kSolving = "solving for the modes";

/// A vector of PETSc's on memory of `size` numbers that outlives it.
VecHandle wrap(const double* values, Eigen::Index size) {
  VecHandle vector;
  require(
      VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(size), values, vector.out()),
      kSolving);
  return vector;
}

/// M x, column by column.
Eigen::MatrixXd multiply_columns(Mat mass, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd result(x.rows(), x.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const VecHandle in = wrap(x.col(k).data(), x.rows());
    const VecHandle out = wrap(result.col(k).data(), x.rows());
    require(MatMult(mass, in.get(), out.get()), kSolving);
  }
  return result;
}

}  // namespace

EigenPairs lowest_eigenpairs(Mat mass, const CholeskyFactor& factor, Eigen::Index count) {
  PetscInt size = 0;
  require(MatGetSize(mass, &size, nullptr), kSolving);
  const BlockOperator solve = [&](const Eigen::MatrixXd& forces) { return factor.solve(forces); };
  const BlockOperator multiply = [&](const Eigen::MatrixXd& x) {
    return multiply_columns(mass, x);
  };
  const RitzPairs pairs = largest_eigenpairs(solve, multiply, size, count);
  EigenPairs result;
  result.values = factor.shift() + pairs.values.array().inverse();
  // One more solve takes out what rounding has left of the highest modes, which the residual sees
  // far larger than the eigenvector.
  result.vectors = factor.solve(multiply(pairs.vectors));
  const Eigen::MatrixXd modal_mass = transpose_times(result.vectors, multiply(result.vectors));
  modal_mass.llt().matrixL().transpose().solveInPlace<Eigen::OnTheRight>(result.vectors);
  return result;
}

Eigen::VectorXd relative_residuals(Mat stiffness, Mat mass, const EigenPairs& pairs, double shift) {
  const Eigen::Index size = pairs.vectors.rows();
  Eigen::VectorXd force(size);
  Eigen::VectorXd momentum(size);
  const VecHandle force_vector = wrap(force.data(), size);
  const VecHandle momentum_vector = wrap(momentum.data(), size);
  Eigen::VectorXd residuals(pairs.values.size());
  for (Eigen::Index k = 0; k < residuals.size(); ++k) {
    const VecHandle shape = wrap(pairs.vectors.col(k).data(), size);
    require(MatMult(stiffness, shape.get(), force_vector.get()), kSolving);
    require(MatMult(mass, shape.get(), momentum_vector.get()), kSolving);
    const double scale = pairs.values[k] == 0 ? std::abs(shift) * momentum.norm() : force.norm();
    residuals[k] = (force - pairs.values[k] * momentum).norm() / scale;
  }
  return residuals;
}

}  // namespace flexneck::fe_modal
