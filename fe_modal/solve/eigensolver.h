// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/eigen_pairs.h"
#include "fe_modal/algebra/petsc_handles.h"
#include "fe_modal/algebra/shift_inverse.h"

namespace flexneck::fe_modal {

/// By block Lanczos on the shift-inverted problem (K - shift M)^-1 M, with as many columns as a
/// multiple eigenvalue may have copies, then one inverse iteration of all pairs; or by the
/// inverse's own method where it has one.
/// @param inverse of K - shift M, with a shift below all eigenvalues
/// @param mass symmetric positive definite; may be a shell matrix, and differ from the mass in the
/// inverse if the shift is zero
/// @param count at most the number of degrees of freedom
/// @throws ComputationError if the iteration does not converge.
EigenPairs lowest_eigenpairs(Mat mass, const ShiftInverse& inverse, Eigen::Index count);

/// ||K x - lambda M x|| / ||K x|| of each pair; of a rigid-body motion, lambda = 0, where that is
/// not defined, ||K x|| / ||shift M x||.
Eigen::VectorXd relative_residuals(Mat stiffness, Mat mass, const ShiftInverse& inverse,
                                   const EigenPairs& pairs);

}  // namespace flexneck::fe_modal
