// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/algebra/block_product.h"

namespace flexneck::fe_modal {

/// A x = b for each column by preconditioned conjugate gradients with a block of directions, in
/// which all columns share (O'Leary, Linear Algebra Appl. 29 (1980) 293); those that have become
/// dependent are dropped (Ji and Li, BIT 57 (2017) 379). Ends a step after r^T P r of each column,
/// near the square of the error in the energy norm, is 1e-20 of what it was at first and of the
/// energy that is known.
/// @param matrix A, symmetric, positive definite on the range of P
/// @param preconditioner P, symmetric, near the inverse of A
/// @param known_energies of each column: of what has been taken out of the solution before, of
///     which this finds the rest; empty if nothing has
/// @throws ComputationError if one does not converge in so many iterations.
Eigen::MatrixXd conjugate_gradients(const Ranks& ranks, const BlockOperator& matrix,
                                    const BlockOperator& preconditioner,
                                    const Eigen::MatrixXd& right_hand_sides,
                                    const Eigen::VectorXd& known_energies = {},
                                    int max_iterations = 2000);

}  // namespace flexneck::fe_modal
