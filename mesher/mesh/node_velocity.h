// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// @throws InputError if one has other elements, faces or slits than the other: it tells which.
/// Node sets may differ, since they may be chosen by distances: nothing is said of them.
void require_same_topology(const Mesh& mesh, const Mesh& other);

/// How the nodes move with a parameter, (3, n) in m per unit of it: the quotient of the positions'
/// differences between the meshes of two of its values. Where positions are linear in it, it is
/// exact; the middle of the two is the parameter's value then, for an error of second order.
/// @param mesh whose nodes they are
/// @param width difference of the two values, not zero
/// @throws InputError as require_same_topology, of either.
Eigen::Matrix3Xd node_velocity(const Mesh& mesh, const Mesh& below, const Mesh& above,
                               double width);

}  // namespace flexneck::mesher
