// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include <Eigen/Core>

#include "fe_modal/eigensolver.h"
#include "fe_modal/petsc_handles.h"
#include "fe_modal/shift_inverse.h"

namespace flexneck::fe_modal {

/// Tells from the eigenvalues before and after an iteration whether to stop.
using Settled = std::function<bool(const Eigen::VectorXd& before, const Eigen::VectorXd& after)>;

/// Modes of K x = lambda M x from a space that nearly holds them, by inverse iteration of the whole
/// space with the Ritz method. All columns are solved for at once, which costs a fifth of what as
/// many single solves do. Finds no mode that is M-orthogonal to the space.
/// @param mass may differ from that in the inverse if the shift is zero
/// @param start (dofs, m) columns; what depends on the others is dropped
/// @return up to m pairs, ascending; how good the upper ones are depends on what `settled` asks
/// @throws ComputationError if they do not settle.
EigenPairs inverse_iteration(Mat mass, const ShiftInverse& inverse, Eigen::MatrixXd start,
                             const Settled& settled);

}  // namespace flexneck::fe_modal
