// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/eigen_pairs.h"
#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/solve/linear_solver.h"

namespace flexneck::fe_modal {

/// Error of an iteration that did not find the requested eigenpairs.
class NotConverged : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

/// Lowest eigenpairs of K x = lambda M x by SLEPc's Krylov-Schur method, shift-inverted, and the
/// eigenvalue above them. A Krylov space of one vector contains only one eigenvector of a multiple
/// eigenvalue, until rounding introduces the others: a further search beside the found pairs looks
/// for those that are missing.
/// @param inverse that of K - shift M, with a shift that is no eigenvalue and is below those wanted
/// @param mass symmetric, positive semi-definite; may be a shell matrix, and differ from the mass
/// in the inverse if the shift is zero
/// @param count at most the number of degrees of freedom
/// @param known M-orthonormal eigenvectors that are excluded from the search; may have no columns
/// @throws NotConverged if the iteration does not converge.
EigenPairs lowest_eigenpairs(Mat mass, const LinearSolver& inverse, Eigen::Index count,
                             const Eigen::MatrixXd& known = {});

/// Lowest eigenvalues alone, by the same method with fewer solves.
Eigen::VectorXd lowest_eigenvalues(Mat mass, const LinearSolver& inverse, Eigen::Index count);

/// Largest eigenvalue theta of A x = theta B x by the same method, in the inner product of B.
/// @param inverse that of B
/// @param of_interest smallest eigenvalue that is distinguished from zero
double largest_eigenvalue(Mat a, const LinearSolver& inverse, double of_interest);

/// Relative residual ||K x - lambda M x
/// / ||K x
/// of each pair; for a rigid-body motion, lambda = 0, for which this is not defined, ||K x
/// / ||shift M x||.
Eigen::VectorXd relative_residuals(Mat stiffness, Mat mass, const LinearSolver& inverse,
                                   const EigenPairs& pairs);

}  // namespace flexneck::fe_modal
