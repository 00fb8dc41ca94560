// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/petsc_handles.h"

namespace flexneck::fe_modal {

/// Number of negative eigenvalues of a symmetric matrix of this process, upper half stored, by an
/// indefinite factorisation with MUMPS: of K - sigma M as many as K x = lambda M x has below sigma
/// (Sylvester's law of inertia).
/// @throws ComputationError if one is zero to rounding, or the factorisation fails.
Eigen::Index negative_eigenvalues(Mat shifted);

}  // namespace flexneck::fe_modal
