// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

/// Decompositions by Eigen as an independent reference, in one place: each file that instantiates
/// one takes some ten seconds longer to compile.
namespace flexneck::testing {

struct DensePairs {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< with unit modal mass
};

/// Solves K x = lambda M x.
DensePairs dense_pairs(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);
/// The lowest eigenvalues of K x = lambda M x, ascending, as reciprocals of the largest mu of M x =
/// mu K x with a positive definite K. dense_pairs() has rounding errors proportional to the highest
/// lambda, which are large compared with the lowest if metal is bonded to rubber.
Eigen::VectorXd lowest_values(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                              Eigen::Index count);
/// Eigenvalues of a symmetric matrix, ascending.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);
/// Eigenvalues of any square matrix.
Eigen::VectorXcd complex_eigenvalues(const Eigen::MatrixXd& matrix);
struct ComplexPairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
  Eigen::MatrixXcd inverse;  ///< inverse of the matrix of eigenvectors
};
/// Solves A x = lambda x for a matrix with as many independent eigenvectors as columns.
ComplexPairs complex_pairs(const Eigen::MatrixXd& matrix);
/// Returns A^-1 B with a symmetric A.
Eigen::MatrixXd symmetric_solution(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// Basis of the null space, all x with A x = 0, in columns.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& a);

}  // namespace flexneck::testing
