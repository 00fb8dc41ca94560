// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/element/formulation.h"

namespace flexneck::fe_modal {

/// How many pressures an element has.
Eigen::Index pressure_count(PressureSpace space);

/// Pressures at the q points of an element's stiffness, (q, p), times the roots of the volumes that
/// the points stand for, orthonormal: sums of products over the points are integrals.
/// @param reference (3, q) reference coordinates of the points
/// @param positions (q, 3) of the points; of linear pressures alone, is overwritten
/// @param pressures must have its size
void find_pressures(PressureSpace space, const Eigen::VectorXd& roots,
                    const Eigen::Matrix3Xd& reference, Eigen::MatrixX3d& positions,
                    Eigen::MatrixXd& pressures);

}  // namespace flexneck::fe_modal
