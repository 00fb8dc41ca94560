// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/part_materials.h"

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"

namespace flexneck::mesher {

std::size_t material_index(const std::string& part, const std::vector<Material>& materials,
                           const std::map<std::string, std::string>& material_of_part) {
  const auto entry = material_of_part.find(part);
  if (entry == material_of_part.end()) {
    throw InputError("part '" + part + "' has no material; add it to the parts of a material");
  }
  try {
    return find_name(names_of(materials), entry->second, "material");
  } catch (const InputError& error) {
    throw InputError("part '" + part + "': " + error.what());
  }
}

void require_known_parts(const std::vector<std::string>& parts,
                         const std::map<std::string, std::string>& material_of_part) {
  for (const auto& [part, material] : material_of_part) {
    try {
      find_name(parts, part, "part");
    } catch (const InputError& error) {
      throw InputError("material '" + material + "': " + error.what());
    }
  }
}

}  // namespace flexneck::mesher
