// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fe_modal/iterative/block_davidson.h"

namespace flexneck::fe_modal {

struct ConjugateGradientResult {
  Eigen::MatrixXd solutions;
  int iterations = 0;
};

/// A x = b for each column by preconditioned conjugate gradients with a block of directions, in
/// which all columns share (O'Leary, Linear Algebra Appl. 29 (1980) 293); those that have become
/// dependent are dropped (Ji and Li, BIT 57 (2017) 379). Ends when r^T P r of each column, near the
/// square of the error in the energy norm, has fallen by 1e-20.
/// @throws ComputationError if one does not converge.
ConjugateGradientResult conjugate_gradients(const BlockOperator& matrix,
                                            const BlockOperator& preconditioner,
                                            const Eigen::MatrixXd& right_hand_sides);

}  // namespace flexneck::fe_modal
