// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// Negative eigenvalues of a symmetric matrix, by the signs of the pivots that MUMPS eliminates
/// with (Sylvester's law of inertia): of K - sigma M, how many modes are below sigma. Collective.
/// @throws InputError where memory does not hold the factor.
/// @throws ComputationError if the matrix is singular to rounding, or the factorisation fails.
Eigen::Index negative_eigenvalues(Mat symmetric, const Ranks& ranks);

}  // namespace flexneck::fe_modal
