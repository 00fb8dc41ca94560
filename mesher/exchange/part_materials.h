// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "mesher/mesh/mesh.h"

namespace flexneck::mesher {

/// Position of a part's material among the materials.
/// @throws InputError if the part has none, or one that does not exist.
std::size_t material_index(const std::string& part, const std::vector<Material>& materials,
                           const std::map<std::string, std::string>& material_of_part);

/// Refuses materials of parts that do not exist.
/// @throws InputError naming the part.
void require_known_parts(const std::vector<std::string>& parts,
                         const std::map<std::string, std::string>& material_of_part);

}  // namespace flexneck::mesher
