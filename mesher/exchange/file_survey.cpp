// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/file_survey.h"

#include <string>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {

void compare_with(const Mesh& mesh, const FileSurvey& survey) {
  std::map<std::size_t, std::size_t> found;
  for (const ElementBlock& block : mesh.blocks) {
    found[nodes_per_element(block.kind)] += block.size();
  }
  for (const auto& [nodes, count] : survey.solids) {
    if (found[nodes] == count) continue;
    throw InputError("the file has " + std::to_string(count) + " solid elements of " +
                     std::to_string(nodes) + " nodes, but gmsh reads " +
                     std::to_string(found[nodes]) +
                     " of them; export it anew, a .bdf in small fields, or as a .msh");
  }
}

}  // namespace flexneck::mesher
