// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/symmetric_pairs.h"

#include <Eigen/Eigenvalues>

namespace flexneck {
namespace {

using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
using GeneralizedSolver = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>;

}  // namespace

SymmetricPairs symmetric_pairs(const Eigen::MatrixXd& a) {
  const Solver solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SymmetricPairs symmetric_pairs(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  const GeneralizedSolver solver(a, b);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a) {
  return Solver(a, Eigen::EigenvaluesOnly).eigenvalues();
}

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return GeneralizedSolver(a, b, Eigen::EigenvaluesOnly).eigenvalues();
}

}  // namespace flexneck
