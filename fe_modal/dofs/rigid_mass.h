// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "mesher/mesh/connections.h"

namespace flexneck::fe_modal {

/// Mass matrix of a rigid body about a point, (6, 6): translation of the point, then rotation.
/// @param center_m centre of mass, from the point
/// @param inertia_kg_m2 about the centre of mass
Eigen::Matrix<double, 6, 6> rigid_mass_matrix(double mass_kg, const Eigen::Vector3d& center_m,
                                              const Eigen::Matrix3d& inertia_kg_m2);

/// Mass matrix of a point mass, (6, 6), about its site.
Eigen::Matrix<double, 6, 6> mass_matrix_of(const mesher::PointMass& mass);

/// Moments of inertia of a point mass about its centre.
Eigen::Matrix3d inertia_of(const mesher::PointMass& mass);

}  // namespace flexneck::fe_modal
