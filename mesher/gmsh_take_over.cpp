// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/gmsh_take_over.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include <gmsh.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/face_orientation.h"

namespace flexneck::mesher {
namespace {

/// gmsh's numbers of the element types that a mesh may hold; node orders are the same.
constexpr std::array<std::pair<int, ElementKind>, 10> kKindOfType = {{{5, ElementKind::hex8},
                                                                      {17, ElementKind::hex20},
                                                                      {12, ElementKind::hex27},
                                                                      {18, ElementKind::prism15},
                                                                      {13, ElementKind::prism18},
                                                                      {11, ElementKind::tet10},
                                                                      {3, ElementKind::quad4},
                                                                      {16, ElementKind::quad8},
                                                                      {10, ElementKind::quad9},
                                                                      {9, ElementKind::tri6}}};

std::optional<ElementKind> kind_of(int gmsh_type) {
  const auto* const found = std::find_if(kKindOfType.begin(), kKindOfType.end(),
                                         [&](const auto& row) { return row.first == gmsh_type; });
  return found == kKindOfType.end() ? std::nullopt : std::optional(found->second);
}

std::string name_of_type(int gmsh_type) {
  std::string name;
  int dim = 0;
  int order = 0;
  int nodes = 0;
  int corners = 0;
  std::vector<double> coordinates;
  gmsh::model::mesh::getElementProperties(gmsh_type, name, dim, order, nodes, coordinates, corners);
  return name;
}

struct PhysicalGroup {
  int dimension = 0;
  std::string name;
  std::vector<int> entities;

  std::string label() const {
    return std::string(dimension == 3 ? "physical volume" : "physical surface") + " '" + name + "'";
  }
};

std::vector<PhysicalGroup> physical_groups(int dimension) {
  gmsh::vectorpair tags;
  gmsh::model::getPhysicalGroups(tags, dimension);
  std::sort(tags.begin(), tags.end());
  std::vector<PhysicalGroup> groups;
  for (const auto& [dim, tag] : tags) {
    PhysicalGroup group{.dimension = dim, .name = {}, .entities = {}};
    gmsh::model::getPhysicalName(dim, tag, group.name);
    if (group.name.empty()) {
      throw InputError("the script has a physical group without a name: dimension " +
                       std::to_string(dim) + ", tag " + std::to_string(tag) +
                       "; name it, as in Physical Volume(\"part\") = {…}");
    }
    gmsh::model::getEntitiesForPhysicalGroup(dim, tag, group.entities);
    std::sort(group.entities.begin(), group.entities.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

/// Every volume belongs to one part, or else material would be lost or counted twice.
void require_one_part_per_volume() {
  gmsh::vectorpair volumes;
  gmsh::model::getEntities(volumes, 3);
  for (const auto& [dim, tag] : volumes) {
    std::vector<int> groups;
    gmsh::model::getPhysicalGroupsForEntity(dim, tag, groups);
    if (groups.size() != 1) {
      throw InputError("volume " + std::to_string(tag) + " of the script belongs to " +
                       std::to_string(groups.size()) + " physical volumes, expected one");
    }
  }
}

/// Node tags of a group's elements, row-major (elements, nodes per element), by kind.
using GroupElements = std::map<ElementKind, std::vector<std::size_t>>;

[[noreturn]] void refuse_kinds(const PhysicalGroup& group,
                               const std::map<int, std::size_t>& unknown) {
  std::string found;
  for (const auto& [type, count] : unknown) {
    found += (found.empty() ? "" : " and ") + std::to_string(count) + " of type '" +
             name_of_type(type) + "'";
  }
  std::string known;
  for (const ElementKind kind : element_kinds()) {
    if (dimension(kind) != group.dimension) continue;
    known += (known.empty() ? "" : ", ") + std::string(name_of(kind));
  }
  throw InputError(group.label() + ": expected elements of the kinds " + known + ", found " +
                   found);
}

GroupElements elements_of(const PhysicalGroup& group) {
  GroupElements elements;
  std::map<int, std::size_t> unknown;
  for (const int entity : group.entities) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags;
    std::vector<std::vector<std::size_t>> nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, group.dimension, entity);
    for (std::size_t t = 0; t < types.size(); ++t) {
      if (const auto kind = kind_of(types[t])) {
        auto& all = elements[*kind];
        all.insert(all.end(), nodes[t].begin(), nodes[t].end());
      } else {
        unknown[types[t]] += tags[t].size();
      }
    }
  }
  if (!unknown.empty()) refuse_kinds(group, unknown);
  if (elements.empty()) throw InputError(group.label() + " has no elements");
  return elements;
}

/// gmsh follows an edge in the order of its end points' addresses, so the last bit of a midside
/// node depends on the heap. Positions are rounded to 2^-36 (1.5e-11) of the largest coordinate, so
/// that equal input gives equal bytes.
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

  /// @throws InputError if a tag is none of a part's.
  std::vector<std::int32_t> indices_of(const std::vector<std::size_t>& tags,
                                       const std::string& label) const {
    std::vector<std::int32_t> indices;
    indices.reserve(tags.size());
    for (const std::size_t tag : tags) {
      const auto found = std::lower_bound(tags_.begin(), tags_.end(), tag);
      if (found == tags_.end() || *found != tag) throw InputError(label + " bounds no part");
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
    round_off_noise(positions);
    return positions;
  }

 private:
  std::vector<std::size_t> tags_;  ///< ascending, unique
};

std::size_t material_index(const std::string& part, const std::vector<Material>& materials,
                           const std::map<std::string, std::string>& material_of_part) {
  const auto entry = material_of_part.find(part);
  if (entry == material_of_part.end()) {
    throw InputError("part '" + part + "' has no material; list it under a material's parts");
  }
  try {
    return find_name(names_of(materials), entry->second, "material");
  } catch (const InputError& error) {
    throw InputError("part '" + part + "': " + error.what());
  }
}

/// A material for a part that does not exist is a slip of the pen.
void require_known_parts(const std::vector<PhysicalGroup>& volumes,
                         const std::map<std::string, std::string>& material_of_part) {
  for (const auto& [part, material] : material_of_part) {
    try {
      find_name(names_of(volumes), part, "part");
    } catch (const InputError& error) {
      throw InputError("material '" + material + "': " + error.what());
    }
  }
}

NodeSet node_set_of(const FaceSet& faces) {
  NodeSet set{.name = faces.name, .nodes = {}};
  for (const FaceBlock& block : faces.blocks) {
    set.nodes.insert(set.nodes.end(), block.nodes.begin(), block.nodes.end());
  }
  std::sort(set.nodes.begin(), set.nodes.end());
  set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
  return set;
}

}  // namespace

Mesh take_over_gmsh_mesh(const std::vector<Material>& materials,
                         const std::map<std::string, std::string>& material_of_part) {
  const std::vector<PhysicalGroup> volumes = physical_groups(3);
  if (volumes.empty()) {
    throw InputError("the script has no physical volume; each part needs one, as in " +
                     std::string("Physical Volume(\"part\") = {…}"));
  }
  require_one_part_per_volume();
  require_known_parts(volumes, material_of_part);

  std::vector<GroupElements> parts;
  NodeNumbering numbering;
  for (const PhysicalGroup& volume : volumes) {
    parts.push_back(elements_of(volume));
    for (const auto& [kind, tags] : parts.back()) numbering.add(tags);
  }

  Mesh mesh;
  mesh.nodes = numbering.positions();
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
  for (const PhysicalGroup& surface : physical_groups(2)) {
    FaceSet set{.name = surface.name, .blocks = {}};
    for (const auto& [kind, tags] : elements_of(surface)) {
      FaceBlock faces{.kind = kind, .nodes = numbering.indices_of(tags, surface.label())};
      orient_outwards(mesh, surface.name, faces);
      set.blocks.push_back(std::move(faces));
    }
    mesh.node_sets.push_back(node_set_of(set));
    mesh.face_sets.push_back(std::move(set));
  }
  return mesh;
}

}  // namespace flexneck::mesher
