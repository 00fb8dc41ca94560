// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/element_meshes.h"

namespace flexneck::testing {

namespace {

/// Pyramids on the three facets that do not meet in corner 6, which is their apex.
const std::vector<std::vector<std::size_t>> kPyramids = {
    {0, 1, 2, 3, 6}, {0, 4, 5, 1, 6}, {0, 3, 7, 4, 6}};

/// Pyramids with their apex in another corner: if the reflection that maps 6 to it changes the
/// orientation, their bases are ordered the other way round.
std::vector<std::vector<std::size_t>> pyramids_with_apex(std::size_t apex) {
  const auto hex = mesher::reference_nodes(mesher::ElementKind::hex8);
  auto pieces = kPyramids;
  for (auto& piece : pieces) {
    for (std::size_t& corner : piece) {
      std::array<double, 3> place = hex[corner];
      for (std::size_t d = 0; d < 3; ++d) place[d] *= hex[apex][d];
      corner = static_cast<std::size_t>(std::find(hex.begin(), hex.end(), place) - hex.begin());
    }
    if (hex[apex][0] * hex[apex][1] * hex[apex][2] < 0) std::swap(piece[1], piece[3]);
  }
  return pieces;
}

/// Chooses the apex of the pyramids of each hexahedron of a full box, taken layer by layer, so that
/// neighbours divide the facet between them in the same way: a corner that is one already, or
/// corner 6.
std::size_t choose_apex(std::span<const std::int32_t> nodes, std::set<std::int32_t>& apexes) {
  for (std::size_t corner = 0; corner < 8; ++corner)
    if (apexes.contains(nodes[corner])) return corner;
  apexes.insert(nodes[6]);
  return 6;
}

/// Affine map x -> origin + linear x.
struct ReferenceMap {
  Eigen::Vector3d origin;
  Eigen::Matrix3d linear;
};

/// Map of the reference element of a shape onto a piece with these corners, those of a
/// parallelepiped.
ReferenceMap map_of_piece(mesher::ReferenceShape shape,
                          const std::function<Eigen::Vector3d(std::size_t)>& corner) {
  const auto edge = [&](std::size_t k) -> Eigen::Vector3d { return corner(k) - corner(0); };
  ReferenceMap map{corner(0), Eigen::Matrix3d()};
  switch (shape) {
    case mesher::ReferenceShape::hexahedron:
      map.linear << edge(1) / 2, edge(3) / 2, edge(4) / 2;
      map.origin += map.linear.rowwise().sum();
      break;
    case mesher::ReferenceShape::pyramid:
      map.origin += edge(2) / 2;
      map.linear << edge(1) / 2, edge(3) / 2, corner(4) - map.origin;
      break;
    case mesher::ReferenceShape::prism:
      map.origin += edge(3) / 2;
      map.linear << edge(1), edge(2), edge(3) / 2;
      break;
    default:
      map.linear << edge(1), edge(2), edge(3);
  }
  return map;
}

}  // namespace

std::vector<std::vector<std::size_t>> pieces_of_hexahedron(mesher::ReferenceShape shape) {
  switch (shape) {
    case mesher::ReferenceShape::pyramid:
      return kPyramids;
    case mesher::ReferenceShape::prism:
      return {{0, 1, 2, 4, 5, 6}, {0, 2, 3, 4, 6, 7}};
    case mesher::ReferenceShape::tetrahedron:
      return {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}};
    default:
      return {{0, 1, 2, 3, 4, 5, 6, 7}};
  }
}

std::vector<std::size_t> nodes_of_piece(mesher::ElementKind kind,
                                        const std::vector<std::size_t>& corners) {
  const auto hex = mesher::reference_nodes(mesher::ElementKind::hex27);
  const auto at = [&](std::size_t corner) { return Eigen::Vector3d(hex[corners[corner]].data()); };
  const ReferenceMap map = map_of_piece(mesher::shape_of(kind), at);
  std::vector<std::size_t> result;
  for (const auto& node : mesher::reference_nodes(kind)) {
    const Eigen::Vector3d place = map.origin + map.linear * Eigen::Vector3d(node.data());
    const auto found = std::find_if(hex.begin(), hex.end(), [&](const auto& candidate) {
      return (Eigen::Vector3d(candidate.data()) - place).norm() < 1e-12;
    });
    if (found == hex.end()) throw std::logic_error("no node of the hexahedron there");
    result.push_back(static_cast<std::size_t>(found - hex.begin()));
  }
  return result;
}

void renumber(mesher::Mesh& mesh, const std::vector<std::int32_t>& new_number) {
  const auto apply = [&](std::vector<std::int32_t>& nodes) {
    for (std::int32_t& node : nodes) node = new_number[static_cast<std::size_t>(node)];
  };
  for (mesher::ElementBlock& block : mesh.blocks) apply(block.nodes);
  for (mesher::NodeSet& set : mesh.node_sets) {
    apply(set.nodes);
    std::erase(set.nodes, -1);
  }
  for (mesher::FaceSet& set : mesh.face_sets) {
    for (mesher::FaceBlock& block : set.blocks) apply(block.nodes);
  }
}

void drop_loose_nodes(mesher::Mesh& mesh) {
  std::vector<std::int32_t> new_number(mesh.nodes.size(), -1);
  for (const mesher::ElementBlock& block : mesh.blocks) {
    for (const std::int32_t node : block.nodes) new_number[static_cast<std::size_t>(node)] = 0;
  }
  std::int32_t next = 0;
  for (std::size_t k = 0; k < mesh.nodes.size(); ++k) {
    if (new_number[k] < 0) continue;
    new_number[k] = next;
    mesh.nodes[static_cast<std::size_t>(next++)] = mesh.nodes[k];
  }
  mesh.nodes.resize(static_cast<std::size_t>(next));
  renumber(mesh, new_number);
}

std::vector<mesher::FaceBlock> sides_within(const mesher::Mesh& mesh,
                                            const std::set<std::int32_t>& region) {
  std::map<mesher::ElementKind, std::vector<std::int32_t>> by_kind;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e) {
      for (const mesher::ReferenceFacet& side : mesher::facets_of(block.kind)) {
        std::vector<std::int32_t> nodes;
        for (const std::size_t i : side.nodes) nodes.push_back(block.nodes[width * e + i]);
        if (!std::all_of(nodes.begin(), nodes.end(), [&](auto n) { return region.contains(n); })) {
          continue;
        }
        auto& all = by_kind[side.kind];
        all.insert(all.end(), nodes.begin(), nodes.end());
      }
    }
  }
  std::vector<mesher::FaceBlock> blocks;
  blocks.reserve(by_kind.size());
  for (const auto& [kind, nodes] : by_kind) blocks.push_back({kind, nodes});
  return blocks;
}

mesher::Mesh with_kinds(const mesher::Mesh& hexahedra, const KindChoice& choose) {
  mesher::Mesh mesh = hexahedra;
  mesh.blocks.clear();
  std::set<std::int32_t> apexes;
  for (const mesher::ElementBlock& block : hexahedra.blocks) {
    std::map<mesher::ElementKind, std::vector<std::int32_t>> by_kind;
    for (std::size_t e = 0; e < block.size(); ++e) {
      const auto nodes = std::span(block.nodes).subspan(27 * e, 27);
      const auto kind =
          choose(Eigen::Vector3d(hexahedra.nodes[static_cast<std::size_t>(nodes[26])].data()));
      if (!kind) continue;
      const auto pieces = mesher::shape_of(*kind) == mesher::ReferenceShape::pyramid
                              ? pyramids_with_apex(choose_apex(nodes, apexes))
                              : pieces_of_hexahedron(mesher::shape_of(*kind));
      for (const auto& corners : pieces) {
        for (const std::size_t i : nodes_of_piece(*kind, corners)) {
          by_kind[*kind].push_back(nodes[i]);
        }
      }
    }
    for (const auto& [kind, nodes] : by_kind) {
      mesh.blocks.push_back({block.part, kind, block.material, nodes});
    }
  }
  for (mesher::FaceSet& set : mesh.face_sets) {
    std::set<std::int32_t> region;
    for (const auto& block : set.blocks) region.insert(block.nodes.begin(), block.nodes.end());
    set.blocks = sides_within(mesh, region);
  }
  drop_loose_nodes(mesh);
  return mesh;
}

mesher::Mesh with_kind(const mesher::Mesh& hexahedra, mesher::ElementKind kind) {
  return with_kinds(hexahedra, [kind](const Eigen::Vector3d&) { return kind; });
}

mesher::Mesh with_slit(const mesher::Mesh& whole, double z_m, bool tied,
                       const std::function<bool(const Eigen::Vector3d&)>& cut) {
  mesher::Mesh mesh = whole;
  mesher::Slit slit;
  slit.name = "slit";
  slit.tied = tied;
  std::vector<std::int32_t> double_of(whole.nodes.size(), -1);
  for (std::size_t k = 0; k < whole.nodes.size(); ++k) {
    if (!cut(Eigen::Vector3d(whole.nodes[k].data()))) continue;
    double_of[k] = static_cast<std::int32_t>(mesh.nodes.size());
    slit.lower.push_back(static_cast<std::int32_t>(k));
    slit.upper.push_back(double_of[k]);
    slit.normals.push_back({0, 0, 1});
    slit.areas_m2.push_back(0);
    mesh.nodes.push_back(whole.nodes[k]);
  }
  for (mesher::ElementBlock& block : mesh.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e) {
      const auto nodes = std::span(block.nodes).subspan(width * e, width);
      double middle = 0;
      for (const std::int32_t node : nodes) middle += mesh.nodes[static_cast<std::size_t>(node)][2];
      if (middle < z_m * static_cast<double>(width)) continue;
      for (std::int32_t& node : nodes) {
        const std::int32_t other = double_of[static_cast<std::size_t>(node)];
        if (other >= 0) node = other;
      }
    }
  }
  mesh.slits.push_back(slit);
  return mesh;
}

std::vector<bool> outside_nodes(const mesher::Mesh& mesh) {
  std::map<std::set<std::int32_t>, int> counts;
  const auto for_each_side = [&](const auto& visit) {
    for (const mesher::ElementBlock& block : mesh.blocks) {
      const std::size_t width = mesher::nodes_per_element(block.kind);
      for (std::size_t e = 0; e < block.size(); ++e) {
        for (const mesher::ReferenceFacet& side : mesher::facets_of(block.kind)) {
          std::set<std::int32_t> nodes;
          for (const std::size_t i : side.nodes) nodes.insert(block.nodes[width * e + i]);
          visit(nodes);
        }
      }
    }
  };
  for_each_side([&](const std::set<std::int32_t>& side) { ++counts[side]; });
  std::vector<bool> outside(mesh.nodes.size(), false);
  for (const auto& [side, count] : counts) {
    if (count > 1) continue;
    for (const std::int32_t node : side) outside[static_cast<std::size_t>(node)] = true;
  }
  return outside;
}

}  // namespace flexneck::testing
