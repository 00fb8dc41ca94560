// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

/// Decompositions by Eigen as an independent truth, in one place: each file that compiles one of
/// its own takes some ten seconds longer.
namespace flexneck::testing {

struct DensePairs {
  Eigen::VectorXd values;   ///< ascending
  Eigen::MatrixXd vectors;  ///< of unit mass
};

/// K x = lambda M x
DensePairs dense_pairs(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);
/// The lowest eigenvalues of K x = lambda M x, ascending, as reciprocals of the largest mu of
/// M x = mu K x with a positive definite K. dense_pairs() has rounding errors in proportion to the
/// highest lambda, which are large beside the lowest where metal is bonded to rubber.
Eigen::VectorXd lowest_values(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass,
                              Eigen::Index count);
/// Ascending, of a symmetric matrix.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);
/// Of any square matrix.
Eigen::VectorXcd complex_eigenvalues(const Eigen::MatrixXd& matrix);
struct ComplexPairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
  Eigen::MatrixXcd inverse;  ///< of the vectors
};
/// A x = lambda x of a matrix that has as many vectors as columns.
ComplexPairs complex_pairs(const Eigen::MatrixXd& matrix);
/// A^-1 B with a symmetric A.
Eigen::MatrixXd symmetric_solution(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// The columns span all x with A x = 0.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& a);

}  // namespace flexneck::testing
