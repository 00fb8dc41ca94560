// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Turns the faces so that their normals, dx/dxi x dx/deta, point out of the volume element that
/// they bound. A face between two elements points out of the one that comes first in the mesh. The
/// first node of a face stays the first.
/// @param name of the set, for the message
/// @throws InputError if a face bounds no volume element.
void orient_outwards(const Mesh& mesh, const std::string& name, FaceBlock& faces);

}  // namespace flexneck::mesher
