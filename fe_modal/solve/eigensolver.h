// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/eigen_pairs.h"
#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/solve/linear_solver.h"

namespace flexneck::fe_modal {

/// The iteration did not find what was asked for.
class NotConverged : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

/// The lowest eigenpairs of K x = lambda M x by SLEPc's Krylov-Schur method, shift-inverted, and
/// the eigenvalue above them. A Krylov space of one vector has but one of the eigenvectors of a
/// multiple eigenvalue, until rounding brings the others: what the search missed of those is looked
/// for beside the pairs that it found.
/// @param inverse of K - shift M, with a shift that is no eigenvalue and below those wanted
/// @param mass symmetric, positive semi-definite; may be a shell matrix, and differ from the mass
/// in the inverse if the shift is zero
/// @param count at most the number of degrees of freedom
/// @param known M-orthonormal eigenvectors, which are not found again; may have no columns
/// @throws NotConverged if the iteration does not converge.
EigenPairs lowest_eigenpairs(Mat mass, const LinearSolver& inverse, Eigen::Index count,
                             const Eigen::MatrixXd& known = {});

/// The lowest eigenvalues alone, likewise, for fewer solves.
Eigen::VectorXd lowest_eigenvalues(Mat mass, const LinearSolver& inverse, Eigen::Index count);

/// Largest eigenvalue theta of A x = theta B x by the same method, in the inner product of B.
/// @param inverse of B
/// @param of_interest a smaller one is not told from zero
double largest_eigenvalue(Mat a, const LinearSolver& inverse, double of_interest);

/// ||K x - lambda M x|| / ||K x|| of each pair; of a rigid-body motion, lambda = 0, where that is
/// not defined, ||K x|| / ||shift M x||.
Eigen::VectorXd relative_residuals(Mat stiffness, Mat mass, const LinearSolver& inverse,
                                   const EigenPairs& pairs);

}  // namespace flexneck::fe_modal
