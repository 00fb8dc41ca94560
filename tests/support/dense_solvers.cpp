// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/dense_solvers.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace flexneck::testing {

DensePairs dense_pairs(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd lowest_values(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                              Eigen::Index count) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(mass, stiffness,
                                                                         Eigen::EigenvaluesOnly);
  return solver.eigenvalues().tail(count).reverse().cwiseInverse();
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
}

Eigen::VectorXcd complex_eigenvalues(const Eigen::MatrixXd& matrix) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(matrix, false).eigenvalues();
}

ComplexPairs complex_pairs(const Eigen::MatrixXd& matrix) {
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors(), solver.eigenvectors().inverse()};
}

Eigen::MatrixXd symmetric_solution(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return a.ldlt().solve(b);
}

Eigen::MatrixXd null_space(const Eigen::MatrixXd& a) {
  return Eigen::FullPivLU<Eigen::MatrixXd>(a).kernel();
}

}  // namespace flexneck::testing
