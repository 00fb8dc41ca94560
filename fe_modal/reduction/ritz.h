// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/reduction/operators.h"
#include "fe_modal/solve/eigensolver.h"

namespace flexneck::fe_modal {

/// Ritz pairs of K x = lambda M x in the space of some shapes, less the modes' part of them.
/// @param shapes (dofs, k), independent of one another and of the modes
/// @param modes M-orthonormal eigenvectors, (dofs, m); may have no columns
/// @return k pairs, ascending, M-orthonormal and M-orthogonal to the modes
EigenPairs ritz_pairs(const BodyOperators& body, const Eigen::MatrixXd& modes,
                      Eigen::MatrixXd shapes);

}  // namespace flexneck::fe_modal
