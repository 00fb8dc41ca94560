// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/slits/slits.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include <Eigen/Dense>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/mesh/mesh_measures.h"
#include "mesher/mesh/positions.h"
#include "mesher/mesh/shape_functions.h"
#include "mesher/slits/cut_surroundings.h"
#include "mesher/slits/cut_topology.h"

namespace flexneck::mesher {
namespace {

constexpr std::int32_t kNone = -1;

/// The copies of the nodes that cuts double.
class Copies {
 public:
  Copies(std::size_t node_count, const std::vector<DoubledNode>& doubled)
      : copy_of_(node_count, kNone) {
    auto next = static_cast<std::int32_t>(node_count);
    for (const DoubledNode& each : doubled) copy_of_[static_cast<std::size_t>(each.node)] = next++;
  }

  /// The copy of a node; kNone if the node is not doubled.
  std::int32_t of(std::int32_t node) const { return copy_of_[static_cast<std::size_t>(node)]; }

 private:
  std::vector<std::int32_t> copy_of_;
};

std::vector<std::int32_t> nodes_of_facet(const CutSurroundings& near,
                                         const CutSurroundings::KnownFacet& side) {
  const CutSurroundings::Element& element = near.elements[side.element];
  const ElementBlock& block = near.mesh.blocks[element.block];
  const std::size_t first = element.number * nodes_per_element(block.kind);
  std::vector<std::int32_t> nodes;
  nodes.reserve(near.side_of(side).nodes.size());
  for (const std::size_t local : near.side_of(side).nodes) {
    nodes.push_back(block.nodes[first + local]);
  }
  return nodes;
}

/// The element blocks in which the upper lips use the copies.
std::vector<ElementBlock> opened_blocks(const CutSurroundings& near, CutTopology& topology,
                                        const Copies& copies) {
  std::vector<ElementBlock> blocks = near.mesh.blocks;
  for (std::size_t t = 0; t < near.elements.size(); ++t) {
    const CutSurroundings::Element& element = near.elements[t];
    ElementBlock& block = blocks[element.block];
    const std::size_t first = element.number * nodes_per_element(block.kind);
    const auto incidences = near.incidences_of(t);
    for (std::size_t i = 0; i < incidences.size(); ++i) {
      if (!topology.takes_copy(element.first_incidence + i)) continue;
      block.nodes[first + incidences[i].local] = copies.of(incidences[i].node);
    }
  }
  return blocks;
}

/// The facet that a face with doubled nodes belongs to: below a cut, or of the first element.
const CutSurroundings::KnownFacet& owner_of(const CutSurroundings& near,
                                            const CutTopology& topology, const FacetKey& key,
                                            const std::string& set) {
  const auto has_key = [](const auto& side, const FacetKey& wanted) { return side.key < wanted; };
  const auto side = std::lower_bound(near.sides.begin(), near.sides.end(), key, has_key);
  if (side == near.sides.end() || side->key != key) {
    throw InputError("face set '" + set + "' has a face that is on the boundary of no part");
  }
  if (const CutSurroundings::Face* const face = near.face_with(key)) {
    return *topology.faces()[static_cast<std::size_t>(face - near.faces.data())].lower;
  }
  return *side;
}

/// The face set after opening: faces with doubled nodes take the nodes of the facet that they
/// belong to.
FaceSet opened_faces(const CutSurroundings& near, CutTopology& topology, const Copies& copies,
                     FaceSet set) {
  for (FaceBlock& block : set.blocks) {
    const std::size_t n = nodes_per_element(block.kind);
    for (std::size_t f = 0; f < block.size(); ++f) {
      const auto face = std::span(block.nodes).subspan(f * n, n);
      if (std::none_of(face.begin(), face.end(),
                       [&](std::int32_t node) { return copies.of(node) != kNone; })) {
        continue;
      }
      const CutSurroundings::KnownFacet& owner =
          owner_of(near, topology, key_of_face(block.kind, face), set.name);
      const std::vector<std::size_t>& locals = near.side_of(owner).nodes;
      std::vector<std::int32_t> nodes = nodes_of_facet(near, owner);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::size_t incidence = near.incidence_at(owner.element, locals[i]);
        if (incidence < near.incidences.size() && topology.takes_copy(incidence)) {
          nodes[i] = copies.of(nodes[i]);
        }
      }
      std::copy(nodes.begin(), nodes.end(), face.begin());
    }
  }
  return set;
}

/// Nodes of the face set of this name, ascending; none if there is no such set.
std::vector<std::int32_t> nodes_of_faces(const std::vector<FaceSet>& sets,
                                         const std::string& name) {
  std::vector<std::int32_t> nodes;
  for (const FaceSet& set : sets) {
    if (set.name != name) continue;
    for (const FaceBlock& block : set.blocks) {
      nodes.insert(nodes.end(), block.nodes.begin(), block.nodes.end());
    }
  }
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

NodeSet opened_nodes(const Copies& copies, const std::vector<FaceSet>& opened_sets, NodeSet set) {
  const bool is_cut = std::any_of(set.nodes.begin(), set.nodes.end(),
                                  [&](std::int32_t node) { return copies.of(node) != kNone; });
  if (!is_cut) return set;
  const std::vector<std::int32_t> on_faces = nodes_of_faces(opened_sets, set.name);
  const auto has = [&](std::int32_t node) {
    return std::binary_search(on_faces.begin(), on_faces.end(), node);
  };
  std::vector<std::int32_t> nodes;
  for (const std::int32_t node : set.nodes) {
    const std::int32_t copy = copies.of(node);
    const bool faces_know = copy != kNone && (has(node) || has(copy));
    if (!faces_know || has(node)) nodes.push_back(node);
    if (copy != kNone && (!faces_know || has(copy))) nodes.push_back(copy);
  }
  std::sort(nodes.begin(), nodes.end());
  set.nodes = std::move(nodes);
  return set;
}

/// int N dA and the normals of a face at its nodes; a normal has the length of the surface element.
struct FaceWeights {
  Eigen::VectorXd areas_m2;
  Eigen::Matrix3Xd normals;
};

Eigen::Matrix3Xd normals_at(const Eigen::Matrix3Xd& x, const ShapeTable& table) {
  const Eigen::Matrix3Xd along_xi = x * table.derivatives[0];
  const Eigen::Matrix3Xd along_eta = x * table.derivatives[1];
  Eigen::Matrix3Xd normals(3, table.values.cols());
  for (Eigen::Index q = 0; q < normals.cols(); ++q) {
    const Eigen::Vector3d xi = along_xi.col(q);
    normals.col(q) = xi.cross(Eigen::Vector3d(along_eta.col(q)));
  }
  return normals;
}

FaceWeights weights_of(ElementKind kind, const Eigen::Matrix3Xd& x) {
  const Quadrature rule = gauss_rule(kind, 4);  // the finest rule: the integrand on a curved face
                                                // has a square root
  const ShapeTable at_rule = tabulate(kind, rule.points);
  const auto nodes = reference_nodes(kind);
  Eigen::Matrix3Xd node_points(3, static_cast<Eigen::Index>(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    node_points.col(static_cast<Eigen::Index>(n)) = Eigen::Vector3d(nodes[n].data());
  }
  const Eigen::VectorXd surface_m2 = normals_at(x, at_rule).colwise().norm().transpose();
  return {at_rule.values * surface_m2.cwiseProduct(rule.weights),
          normals_at(x, tabulate(kind, node_points))};
}

std::vector<Slit> slits_of(const CutSurroundings& near, const CutTopology& topology,
                           const Copies& copies, const std::vector<std::string>& names, bool tied) {
  const auto first_copy = static_cast<std::int32_t>(near.mesh.nodes.size());
  const std::vector<DoubledNode>& doubled = topology.doubled();
  Eigen::VectorXd areas_m2 = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(doubled.size()));
  Eigen::Matrix3Xd normals = Eigen::Matrix3Xd::Zero(3, areas_m2.size());
  for (const CutFace& face : topology.faces()) {
    const std::vector<std::int32_t> nodes = nodes_of_facet(near, *face.lower);
    const FaceWeights weights =
        weights_of(near.side_of(*face.lower).kind, positions_of(near.mesh, nodes));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::int32_t copy = copies.of(nodes[i]);
      if (copy == kNone) continue;
      areas_m2[copy - first_copy] += weights.areas_m2[static_cast<Eigen::Index>(i)];
      normals.col(copy - first_copy) += weights.normals.col(static_cast<Eigen::Index>(i));
    }
  }
  std::vector<Slit> slits(names.size());
  for (std::size_t s = 0; s < names.size(); ++s) {
    slits[s].name = names[s];
    slits[s].tied = tied;
  }
  for (std::size_t p = 0; p < doubled.size(); ++p) {
    Slit& slit = slits[doubled[p].cut];
    const auto column = static_cast<Eigen::Index>(p);
    const Eigen::Vector3d normal = normals.col(column).normalized();
    slit.lower.push_back(doubled[p].node);
    slit.upper.push_back(copies.of(doubled[p].node));
    slit.normals.push_back({normal.x(), normal.y(), normal.z()});
    slit.areas_m2.push_back(areas_m2[column]);
  }
  return slits;
}

std::vector<const FaceSet*> sets_named(const Mesh& mesh, const std::vector<std::string>& names) {
  check_names(names, "slit");
  std::vector<const FaceSet*> sets;
  sets.reserve(names.size());
  for (const std::string& name : names) sets.push_back(&mesh.face_set(name));
  return sets;
}

void require_open(const std::vector<Slit>& slits) {
  for (const Slit& slit : slits) {
    if (!slit.lower.empty()) continue;
    throw InputError("slit '" + slit.name +
                     "': no node of its faces is separated, since all lie on its inner edge; "
                     "refine the slit, or let it end at a free surface");
  }
}

}  // namespace

void open_slits(Mesh& mesh, const std::vector<std::string>& face_sets, bool tied) {
  if (face_sets.empty()) return;
  const CutSurroundings near(mesh, sets_named(mesh, face_sets));
  CutTopology topology(near, face_sets);
  const Copies copies(mesh.nodes.size(), topology.doubled());
  std::vector<Slit> slits = slits_of(near, topology, copies, face_sets, tied);
  require_open(slits);

  std::vector<FaceSet> opened_face_sets;
  for (const FaceSet& set : mesh.face_sets) {
    opened_face_sets.push_back(opened_faces(near, topology, copies, set));
  }
  std::vector<NodeSet> opened_node_sets;
  for (const NodeSet& set : mesh.node_sets) {
    opened_node_sets.push_back(opened_nodes(copies, opened_face_sets, set));
  }
  std::vector<ElementBlock> blocks = opened_blocks(near, topology, copies);

  mesh.blocks = std::move(blocks);
  mesh.face_sets = std::move(opened_face_sets);
  mesh.node_sets = std::move(opened_node_sets);
  mesh.nodes.reserve(mesh.nodes.size() + topology.doubled().size());
  for (const DoubledNode& each : topology.doubled()) {
    mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(each.node)]);
  }
  mesh.slits.insert(mesh.slits.end(), slits.begin(), slits.end());
}

}  // namespace flexneck::mesher
