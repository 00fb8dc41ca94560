// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// How the nodes move with a parameter, (3, n) in m per unit of it: the quotient of the positions'
/// differences between the meshes of two of its values. Where positions are linear in it, it is
/// exact; the middle of the two is the parameter's value then, for an error of second order.
/// Node sets may differ, since they may be chosen by distances: nothing is said of them.
/// @param mesh whose nodes they are
/// @param width difference of the two values, not zero
/// @throws InputError if one of the two has other elements, faces or slits: it tells which.
Eigen::Matrix3Xd node_velocity(const Mesh& mesh, const Mesh& below, const Mesh& above,
                               double width);

}  // namespace flexneck::mesher
