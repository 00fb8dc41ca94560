// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/face_orientation.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "geometry/foundation/error.h"
#include "mesher/mesh/facet_key.h"

namespace flexneck::mesher {
namespace {

using NodeList = std::vector<std::int32_t>;

/// Index of the faces of a block by their corners.
class FaceIndex {
 public:
  FaceIndex(const FaceBlock& faces, std::size_t node_count) : on_faces_(node_count, false) {
    const std::size_t n = nodes_per_element(faces.kind);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const FacetKey key = key_of_face(faces.kind, std::span(faces.nodes).subspan(f * n, n));
      faces_.emplace_back(key, f);
      for (const std::int32_t node : key) {
        if (node >= 0) on_faces_[static_cast<std::size_t>(node)] = true;
      }
    }
    std::sort(faces_.begin(), faces_.end());
  }

  /// Faces with the corners of this facet; quickly found to be none for nearly every facet of a
  /// mesh.
  std::span<const std::pair<FacetKey, std::size_t>> find(
      const ReferenceFacet& side, std::span<const std::int32_t> element) const {
    const std::size_t corners = corners_per_element(side.kind);
    for (std::size_t c = 0; c < corners; ++c) {
      if (!on_faces_[static_cast<std::size_t>(element[side.nodes[c]])]) return {};
    }
    const FacetKey key = key_of_facet(side, element);
    const auto less = [](const auto& a, const auto& b) { return a.first < b.first; };
    const auto [first, last] =
        std::equal_range(faces_.begin(), faces_.end(), std::pair(key, std::size_t{0}), less);
    return {first, last};
  }

 private:
  std::vector<bool> on_faces_;  ///< by node: true if it is a corner of a face
  std::vector<std::pair<FacetKey, std::size_t>> faces_;
};

/// Nodes of each face in the order that makes the normal point out of the first volume element with
/// such a facet; empty if there is none.
std::vector<NodeList> outward_faces(const Mesh& mesh, const FaceBlock& faces) {
  const FaceIndex index(faces, mesh.nodes.size());
  std::vector<NodeList> outward(faces.size());
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t n = nodes_per_element(block.kind);
    const std::span<const ReferenceFacet> sides = facets_of(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      const auto element = std::span(block.nodes).subspan(first, n);
      for (const ReferenceFacet& side : sides) {
        if (side.kind != faces.kind) continue;
        for (const auto& [key, face] : index.find(side, element)) {
          if (!outward[face].empty()) continue;
          for (const std::size_t local : side.nodes) outward[face].push_back(element[local]);
        }
      }
    }
  }
  return outward;
}

/// The same face beginning with another of its corners: corners and edges rotate by `steps`, a
/// centre node stays.
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
  const std::vector<NodeList> outward = outward_faces(mesh, faces);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const NodeList& side = outward[f];
    if (side.empty()) {
      throw InputError("physical surface '" + name +
                       "' has a face that is on the boundary of no part");
    }
    const auto start = std::find(side.begin(), side.end(), faces.nodes[f * n]) - side.begin();
    const NodeList from_start = turned(side, corners, static_cast<std::size_t>(start));
    std::copy(from_start.begin(), from_start.end(),
              faces.nodes.begin() + static_cast<std::ptrdiff_t>(f * n));
  }
}

}  // namespace flexneck::mesher
