// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/boundary_faces.h"

#include <algorithm>
#include <map>

namespace flexneck::mesher {
namespace {

using NodeList = std::vector<std::int32_t>;

struct Face {
  ElementKind kind;
  NodeList nodes;
  bool is_shared = false;
};

FaceBlock& block_of(FaceSet& set, ElementKind kind) {
  const auto found = std::find_if(set.blocks.begin(), set.blocks.end(),
                                  [&](const FaceBlock& block) { return block.kind == kind; });
  if (found != set.blocks.end()) return *found;
  return set.blocks.emplace_back(FaceBlock{kind, {}});
}

}  // namespace

FaceSet boundary_faces(const Mesh& mesh, const std::string& name,
                       const std::function<bool(std::int32_t)>& is_wanted) {
  std::vector<Face> faces;
  std::map<NodeList, std::size_t> face_of;  // by sorted nodes
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t n = nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      for (const Side& side : sides_of(block.kind)) {
        NodeList nodes;
        for (const std::size_t local : side.nodes) nodes.push_back(block.nodes[first + local]);
        if (!std::all_of(nodes.begin(), nodes.end(), is_wanted)) continue;
        NodeList sorted = nodes;
        std::sort(sorted.begin(), sorted.end());
        const auto [entry, is_new] = face_of.emplace(std::move(sorted), faces.size());
        if (is_new) {
          faces.push_back({side.kind, std::move(nodes)});
        } else {
          faces[entry->second].is_shared = true;
        }
      }
    }
  }
  FaceSet set{.name = name, .blocks = {}};
  for (const Face& face : faces) {
    if (face.is_shared) continue;
    NodeList& nodes = block_of(set, face.kind).nodes;
    nodes.insert(nodes.end(), face.nodes.begin(), face.nodes.end());
  }
  return set;
}

}  // namespace flexneck::mesher
