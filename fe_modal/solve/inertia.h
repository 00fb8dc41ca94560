// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// Number of negative eigenvalues of a symmetric matrix, by the signs of the pivots of MUMPS
/// (Sylvester's law of inertia): for K - sigma M, the number of modes below sigma. Collective.
/// @throws InputError if memory does not hold the factor.
/// @throws ComputationError if the matrix is singular to rounding, or the factorisation fails.
Eigen::Index negative_eigenvalues(Mat symmetric, const Ranks& ranks);

}  // namespace flexneck::fe_modal
