// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/gmsh/gmsh_mesh_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include <gmsh.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/exchange/part_materials.h"
#include "mesher/mesh/face_orientation.h"

namespace flexneck::mesher {
namespace {

/// Rounds the positions. gmsh follows an edge in the order of its end points' addresses, so the
/// last bit of a midside node depends on the heap. Positions are rounded to 2^-36 (1.5e-11) of the
/// largest coordinate, so that equal input gives equal bytes.
void round_off_noise(std::vector<std::array<double, 3>>& positions) {
  double largest = 0;
  for (const auto& x : positions) {
    for (const double coordinate : x) largest = std::max(largest, std::abs(coordinate));
  }
  if (!(largest > 0 && std::isfinite(largest))) return;
  const double grid = std::ldexp(1.0, std::ilogb(largest) - 35);
  for (auto& x : positions) {
    for (double& coordinate : x) {
      coordinate = std::nearbyint(coordinate / grid) * grid + 0.0;  // + 0 turns -0 into 0
    }
  }
}

/// Numbers the nodes of the parts from 0, in the order of gmsh's tags.
class NodeNumbering {
 public:
  void add(const std::vector<std::size_t>& tags) {
    tags_.insert(tags_.end(), tags.begin(), tags.end());
    std::sort(tags_.begin(), tags_.end());
    tags_.erase(std::unique(tags_.begin(), tags_.end()), tags_.end());
  }

  /// @throws InputError if a tag belongs to no node of a part.
  std::vector<std::int32_t> indices_of(const std::vector<std::size_t>& tags,
                                       const std::string& label) const {
    std::vector<std::int32_t> indices;
    indices.reserve(tags.size());
    for (const std::size_t tag : tags) {
      const auto found = std::lower_bound(tags_.begin(), tags_.end(), tag);
      if (found == tags_.end() || *found != tag)
        throw InputError(label + " is on the boundary of no part");
      indices.push_back(static_cast<std::int32_t>(found - tags_.begin()));
    }
    return indices;
  }

  std::vector<std::array<double, 3>> positions() const {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates;
    std::vector<double> parameters;
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
    std::vector<std::array<double, 3>> positions(tags_.size());
    for (std::size_t n = 0; n < tags.size(); ++n) {
      const auto found = std::lower_bound(tags_.begin(), tags_.end(), tags[n]);
      if (found == tags_.end() || *found != tags[n]) continue;
      positions[static_cast<std::size_t>(found - tags_.begin())] = {
          coordinates[3 * n], coordinates[3 * n + 1], coordinates[3 * n + 2]};
    }
    return positions;
  }

 private:
  std::vector<std::size_t> tags_;  ///< ascending, unique
};

void add_face_sets(Mesh& mesh, const NodeNumbering& numbering, GmshSource source,
                   const GroupNames& names) {
  for (const GmshGroup& surface : gmsh_groups(2, source, names)) {
    FaceSet set{.name = surface.name, .blocks = {}};
    for (const auto& [kind, tags] : elements_of(surface)) {
      FaceBlock faces{.kind = kind, .nodes = numbering.indices_of(tags, surface.label())};
      orient_outwards(mesh, surface.name, faces);
      set.blocks.push_back(std::move(faces));
    }
    mesh.node_sets.push_back(nodes_of(set));
    mesh.face_sets.push_back(std::move(set));
  }
}

/// Adds the node sets. Surfaces, curves and points of the same name form one node set.
void add_node_sets(Mesh& mesh, const NodeNumbering& numbering, GmshSource source,
                   const GroupNames& names) {
  for (const int dimension : {1, 0}) {
    for (const GmshGroup& group : gmsh_groups(dimension, source, names)) {
      std::vector<std::int32_t> nodes = numbering.indices_of(node_tags_of(group), group.label());
      const auto known = std::find_if(mesh.node_sets.begin(), mesh.node_sets.end(),
                                      [&](const NodeSet& set) { return set.name == group.name; });
      if (known == mesh.node_sets.end()) {
        mesh.node_sets.push_back({group.name, std::move(nodes)});
        continue;
      }
      std::vector<std::int32_t> all;
      std::set_union(known->nodes.begin(), known->nodes.end(), nodes.begin(), nodes.end(),
                     std::back_inserter(all));
      known->nodes = std::move(all);
    }
  }
}

}  // namespace

Mesh import_gmsh_mesh(const std::vector<Material>& materials,
                      const std::map<std::string, std::string>& material_of_part, GmshSource source,
                      const GroupNames& names) {
  const std::vector<GmshGroup> volumes = gmsh_groups(3, source, names);
  if (volumes.empty()) {
    throw InputError(source == GmshSource::script
                         ? "the script has no physical volume; each part needs one, for example "
                           "Physical Volume(\"part\") = {…}"
                         : "expected volume elements, found none");
  }
  require_one_part_per_volume(volumes);
  require_known_parts(names_of(volumes), material_of_part);

  std::vector<GroupElements> parts;
  NodeNumbering numbering;
  for (const GmshGroup& volume : volumes) {
    parts.push_back(elements_of(volume));
    for (const auto& [kind, tags] : parts.back()) numbering.add(tags);
  }

  Mesh mesh;
  mesh.nodes = numbering.positions();
  if (source == GmshSource::script) round_off_noise(mesh.nodes);
  mesh.materials = materials;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::string& part = volumes[p].name;
    for (const auto& [kind, tags] : parts[p]) {
      mesh.blocks.push_back({.part = part,
                             .kind = kind,
                             .material = material_index(part, materials, material_of_part),
                             .nodes = numbering.indices_of(tags, volumes[p].label())});
    }
  }
  add_face_sets(mesh, numbering, source, names);
  add_node_sets(mesh, numbering, source, names);
  return mesh;
}

}  // namespace flexneck::mesher
