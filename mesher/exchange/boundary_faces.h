// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Faces of the mesh's surface, those that bound one element only, whose nodes all satisfy
/// `is_wanted`; normals outwards, in the order of the elements. Without any, no blocks.
FaceSet boundary_faces(const Mesh& mesh, const std::string& name,
                       const std::function<bool(std::int32_t)>& is_wanted);

}  // namespace flexneck::mesher
