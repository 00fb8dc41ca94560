// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Position of a part's material among the materials.
/// @throws InputError if the part has none, or one that is not there.
std::size_t material_index(const std::string& part, const std::vector<Material>& materials,
                           const std::map<std::string, std::string>& material_of_part);

/// A material for a part that does not exist is a slip of the pen.
/// @throws InputError naming it.
void require_known_parts(const std::vector<std::string>& parts,
                         const std::map<std::string, std::string>& material_of_part);

}  // namespace flexneck::mesher
