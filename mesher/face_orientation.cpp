// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/face_orientation.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

using NodeList = std::vector<std::int32_t>;

NodeList sorted(NodeList nodes) {
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

NodeList face_at(const FaceBlock& faces, std::size_t first) {
  const auto begin = faces.nodes.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(nodes_per_element(faces.kind))};
}

/// Nodes of the sides that are wanted as the first volume element with such a side sees them, in
/// the order that makes the normal point out of it; by the sorted nodes.
std::map<NodeList, NodeList> outward_sides(const Mesh& mesh, std::map<NodeList, NodeList> wanted) {
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t n = nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      for (const Side& side : sides_of(block.kind)) {
        NodeList nodes;
        nodes.reserve(side.nodes.size());
        for (const std::size_t local : side.nodes) nodes.push_back(block.nodes[first + local]);
        const auto found = wanted.find(sorted(nodes));
        if (found != wanted.end() && found->second.empty()) found->second = std::move(nodes);
      }
    }
  }
  return wanted;
}

/// The same face from another of its corners on: corners and edges turn by `steps`, a centre stays.
NodeList turned(const NodeList& face, std::size_t corners, std::size_t steps) {
  NodeList result = face;
  for (std::size_t i = 0; i < 2 * corners && i < face.size(); ++i) {
    const std::size_t ring = i / corners * corners;
    result[i] = face[ring + (i - ring + steps) % corners];
  }
  return result;
}

}  // namespace

void orient_outwards(const Mesh& mesh, const std::string& name, FaceBlock& faces) {
  const std::size_t n = nodes_per_element(faces.kind);
  const std::size_t corners = corners_per_element(faces.kind);
  std::map<NodeList, NodeList> wanted;
  for (std::size_t first = 0; first < faces.nodes.size(); first += n) {
    wanted.emplace(sorted(face_at(faces, first)), NodeList());
  }
  const auto outward = outward_sides(mesh, std::move(wanted));

  for (std::size_t first = 0; first < faces.nodes.size(); first += n) {
    const NodeList& side = outward.at(sorted(face_at(faces, first)));
    if (side.empty()) {
      throw InputError("physical surface '" + name + "' has a face that bounds no part");
    }
    const auto start = std::find(side.begin(), side.end(), faces.nodes[first]) - side.begin();
    const NodeList from_start = turned(side, corners, static_cast<std::size_t>(start));
    std::copy(from_start.begin(), from_start.end(),
              faces.nodes.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

}  // namespace flexneck::mesher
