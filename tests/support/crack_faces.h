// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mesher/mesh/element_kind.h"
#include "mesher/mesh/mesh.h"

namespace flexneck::testing {

/// Lower facets of the elements of a block of 27-node hexahedra whose nodes there all satisfy a
/// condition.
inline mesher::FaceSet crack_faces(const mesher::Mesh& mesh, const std::string& name,
                                   const std::function<bool(const Eigen::Vector3d&)>& is_in_crack) {
  mesher::FaceBlock faces;
  const mesher::ElementBlock& block = mesh.blocks.front();
  const mesher::ReferenceFacet& below = mesher::facets_of(block.kind)[0];
  for (std::size_t first = 0; first < block.nodes.size(); first += 27) {
    std::vector<std::int32_t> side;
    bool is_in = true;
    for (const std::size_t local : below.nodes) {
      side.push_back(block.nodes[first + local]);
      is_in = is_in && is_in_crack(Eigen::Vector3d::Map(
                           mesh.nodes[static_cast<std::size_t>(side.back())].data()));
    }
    if (is_in) faces.nodes.insert(faces.nodes.end(), side.begin(), side.end());
  }
  return {name, {faces}};
}

}  // namespace flexneck::testing
