// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/element/formulation.h"

namespace flexneck::fe_modal {

/// Number of pressures of an element.
Eigen::Index pressure_count(PressureSpace space);

/// Basis of the pressures at the q points of an element's stiffness, (q, p), times the square roots
/// of the points' volumes, orthonormal: sums of products over the points are integrals.
/// @param reference (3, q) reference coordinates of the points
/// @param positions (q, 3) positions of the points; used for linear pressures alone, and
/// overwritten
/// @param pressures must have its size
void find_pressures(PressureSpace space, const Eigen::VectorXd& roots,
                    const Eigen::Matrix3Xd& reference, Eigen::MatrixX3d& positions,
                    Eigen::MatrixXd& pressures);

}  // namespace flexneck::fe_modal
