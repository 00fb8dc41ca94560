// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/face_orientation.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/shape_functions.h"

namespace flexneck::mesher {
namespace {

using NodeList = std::vector<std::int32_t>;

/// For each side of the reference element, such as xi = -1, the local nodes that lie on it.
std::vector<std::vector<std::size_t>> sides_of(ElementKind kind) {
  const auto nodes = reference_nodes(kind);
  std::vector<std::vector<std::size_t>> sides;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const double end : {-1.0, 1.0}) {
      std::vector<std::size_t> side;
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        if (nodes[n][axis] == end) side.push_back(n);
      }
      sides.push_back(std::move(side));
    }
  }
  return sides;
}

/// Order of the nodes of a surface element seen from the other side: xi and eta change places.
std::vector<std::size_t> turned_order(ElementKind kind) {
  const auto nodes = reference_nodes(kind);
  std::vector<std::size_t> order;
  for (const auto& node : nodes) {
    const std::array<double, 3> swapped = {node[1], node[0], node[2]};
    order.push_back(
        static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), swapped) - nodes.begin()));
  }
  return order;
}

/// Centre of the volume element that each face bounds, by the face's sorted nodes.
std::map<NodeList, Eigen::Vector3d> centres_behind(const Mesh& mesh,
                                                   const std::set<NodeList>& faces) {
  std::map<NodeList, Eigen::Vector3d> found;
  for (const ElementBlock& block : mesh.blocks) {
    const auto sides = sides_of(block.kind);
    const std::size_t n = nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e) {
      const std::span<const std::int32_t> element = std::span(block.nodes).subspan(e * n, n);
      for (const auto& side : sides) {
        NodeList key;
        for (const std::size_t local : side) key.push_back(element[local]);
        std::sort(key.begin(), key.end());
        if (faces.contains(key)) {
          found.emplace(std::move(key), positions_of(mesh, element).rowwise().mean());
        }
      }
    }
  }
  return found;
}

NodeList sorted(std::span<const std::int32_t> nodes) {
  NodeList key(nodes.begin(), nodes.end());
  std::sort(key.begin(), key.end());
  return key;
}

}  // namespace

void orient_outwards(const Mesh& mesh, FaceSet& faces) {
  const std::size_t n = nodes_per_element(faces.kind);
  const ShapeTable at_centre = tabulate(faces.kind, Eigen::Vector3d::Zero());
  const std::vector<std::size_t> turned = turned_order(faces.kind);

  std::set<NodeList> wanted;
  for (std::size_t first = 0; first < faces.nodes.size(); first += n) {
    wanted.insert(sorted(std::span(faces.nodes).subspan(first, n)));
  }
  const auto behind = centres_behind(mesh, wanted);

  for (std::size_t first = 0; first < faces.nodes.size(); first += n) {
    const std::span<std::int32_t> face = std::span(faces.nodes).subspan(first, n);
    const auto owner = behind.find(sorted(face));
    if (owner == behind.end()) {
      throw InputError("physical surface '" + faces.name + "' has a face that bounds no part");
    }
    const Eigen::Matrix3Xd x = positions_of(mesh, face);
    const Eigen::Vector3d along_xi = x * at_centre.derivatives[0];
    const Eigen::Vector3d along_eta = x * at_centre.derivatives[1];
    const Eigen::Vector3d outwards = x * at_centre.values - owner->second;
    if (along_xi.cross(along_eta).dot(outwards) > 0) continue;
    const NodeList before(face.begin(), face.end());
    for (std::size_t i = 0; i < n; ++i) face[i] = before[turned[i]];
  }
}

}  // namespace flexneck::mesher
