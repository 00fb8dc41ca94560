// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Turns the faces so that their normals, dx/dxi x dx/deta, point out of the volume element that
/// they bound. A face between two elements points out of the one that comes first in the mesh.
/// @throws InputError if a face bounds no volume element.
void orient_outwards(const Mesh& mesh, FaceSet& faces);

}  // namespace flexneck::mesher
