// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Checks that two meshes have the same elements, faces and slits. Node sets may differ, since they
/// may be selected by distances.
/// @throws InputError naming the difference.
void require_same_topology(const Mesh& mesh, const Mesh& other);

/// Derivative of the node positions with respect to a parameter, (3, n) in m per unit of it: the
/// difference quotient of the positions of two meshes at two of its values. It is exact if
/// positions are linear in the parameter; if the parameter's value is midway between the two, the
/// error is of second order.
/// @param mesh the mesh at the parameter's value
/// @param width difference of the two values, not zero
/// @throws InputError as require_same_topology, for either mesh.
Eigen::Matrix3Xd node_velocity(const Mesh& mesh, const Mesh& below, const Mesh& above,
                               double width);

}  // namespace flexneck::mesher
