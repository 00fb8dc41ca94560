// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/system/assembly.h"

namespace flexneck::fe_modal {

/// Number of negative eigenvalues of a symmetric matrix, upper half stored; the same way.
Eigen::Index negative_eigenvalues(Mat shifted);

/// Number of eigenvalues of K x = lambda M x below sigma: as many as K - sigma M has negative ones
/// (Sylvester's law of inertia). By an indefinite factorisation of its own, with MUMPS: it owes
/// nothing to the eigensolver.
/// @throws ComputationError if sigma is an eigenvalue to rounding, or the factorisation fails.
Eigen::Index eigenvalues_below(const SystemMatrices& system, double sigma);

}  // namespace flexneck::fe_modal
