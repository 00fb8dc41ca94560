// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "fe_modal/element/element_fields.h"
#include "fe_modal/system/rigid_average.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::fe_modal {

/// Average motions of the fields, (6, fields).
Eigen::MatrixXd averages_of(const RigidAverage& region, const Displacements& fields);

/// Derivative of the average motions of a face set about a fixed point (RigidAverage) when the
/// nodes move, the fields' nodal values being fixed: per unit of the parameter that the nodes move
/// with. Finite differences of fourth order over a thousandth of the region: exact to 1e-10 of the
/// motions.
/// @param velocity (3, n), m per unit of the parameter
/// @param fields displacements of all nodes
/// @return (6, fields), translation (3) and rotation (3)
Eigen::MatrixXd average_derivative(const mesher::Mesh& mesh, const mesher::FaceSet& faces,
                                   const Eigen::Vector3d& point_m, const Eigen::Matrix3Xd& velocity,
                                   const Displacements& fields);

}  // namespace flexneck::fe_modal
