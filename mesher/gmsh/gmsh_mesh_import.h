// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "mesher/gmsh/gmsh_groups.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Imports the mesh of gmsh's current model: blocks per physical volume in the order of their tags,
/// one for each kind; a face set per name of physical surfaces; a node set per name of physical
/// surfaces, curves and points. Nodes are those of the volume elements, in the order of gmsh's
/// tags. Faces point out of the part that they bound. Positions of a script's mesh are rounded to
/// 1.5e-11 of the largest, those of a file are kept.
/// @param names of groups whose names gmsh has lost
/// @throws InputError if a script's physical group has no name, a group has no elements or elements
/// of a kind that a mesh cannot hold, a volume is in no or several physical volumes, a part has no
/// material, or a surface, curve or point lies on no part.
Mesh import_gmsh_mesh(const std::vector<Material>& materials,
                      const std::map<std::string, std::string>& material_of_part,
                      GmshSource source = GmshSource::script, const GroupNames& names = {});

}  // namespace flexneck::mesher
