// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Takes the mesh over from gmsh's current model: a block per physical volume in the order of their
/// tags, a face set and a node set per physical surface. Nodes are those of the volume elements, in
/// the order of gmsh's tags, positions rounded to 1.5e-11 of the largest. Faces point out of the
/// part that they bound.
/// @throws InputError if a physical group has no name or no elements, elements are of a kind that
/// is not known or mixed, a volume is in no or several physical volumes, a part has no material, or
/// a face bounds no part.
Mesh take_over_gmsh_mesh(const std::vector<Material>& materials,
                         const std::map<std::string, std::string>& material_of_part);

}  // namespace flexneck::mesher
