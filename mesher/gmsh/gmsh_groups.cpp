// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/gmsh/gmsh_groups.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <gmsh.h>

#include "geometry/foundation/error.h"

namespace flexneck::mesher {
namespace {

constexpr std::array<const char*, 4> kEntityNames = {"point", "curve", "surface", "volume"};

std::string entity_name(int dimension) {
  return kEntityNames.at(static_cast<std::size_t>(dimension));
}

/// The kind of a gmsh element type. Node orders are gmsh's.
std::optional<ElementKind> kind_of(int gmsh_type) {
  for (const ElementKind kind : element_kinds())
    if (traits_of(kind).gmsh_type == gmsh_type) return kind;
  return std::nullopt;
}

/// Elements of an entity: types, and the node tags of each type.
struct EntityElements {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags;
  std::vector<std::vector<std::size_t>> nodes;
};

EntityElements elements_of_entity(int dimension, int entity) {
  EntityElements elements;
  gmsh::model::mesh::getElements(elements.types, elements.tags, elements.nodes, dimension, entity);
  return elements;
}

std::vector<std::size_t> sorted_once(std::vector<std::size_t> tags) {
  std::sort(tags.begin(), tags.end());
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  return tags;
}

void append_nodes(const EntityElements& elements, std::vector<std::size_t>& tags) {
  for (const auto& nodes : elements.nodes) tags.insert(tags.end(), nodes.begin(), nodes.end());
}

/// Tag by which gmsh denotes all entities of a dimension, or all dimensions.
constexpr int kAllEntities = -1;

/// Tags of the nodes of all elements of a dimension, ascending.
std::vector<std::size_t> node_tags_in(int dimension) {
  std::vector<std::size_t> tags;
  append_nodes(elements_of_entity(dimension, kAllEntities), tags);
  return sorted_once(std::move(tags));
}

/// A group for each entity that has elements.
std::vector<GmshGroup> groups_by_entity(int dimension) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  std::sort(entities.begin(), entities.end());
  std::vector<GmshGroup> groups;
  for (const auto& [dim, tag] : entities) {
    if (elements_of_entity(dim, tag).types.empty()) continue;
    groups.push_back({.dimension = dim,
                      .name = entity_name(dim) + "_" + std::to_string(tag),
                      .entities = {tag}});
  }
  return groups;
}

/// Adds a group. Groups of the same name are merged.
void add_group(GmshGroup group, std::vector<GmshGroup>& groups) {
  auto known = std::find_if(groups.begin(), groups.end(),
                            [&](const GmshGroup& other) { return other.name == group.name; });
  if (known == groups.end()) {
    groups.push_back(std::move(group));
    known = groups.end() - 1;
  } else {
    known->entities.insert(known->entities.end(), group.entities.begin(), group.entities.end());
  }
  std::vector<int>& all = known->entities;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

[[noreturn]] void refuse_kinds(const GmshGroup& group, const std::map<int, std::size_t>& unknown) {
  std::string found;
  for (const auto& [type, count] : unknown) {
    found += (found.empty() ? "" : " and ") + std::to_string(count) + " of type '" +
             gmsh_element_type(type).name + "'";
  }
  std::string known;
  for (const ElementKind kind : element_kinds()) {
    if (dimension(kind) != group.dimension) continue;
    known += (known.empty() ? "" : ", ") + std::string(name_of(kind));
  }
  throw InputError(group.label() + ": expected elements of the kinds " + known + ", found " +
                   found);
}

}  // namespace

GmshElementType gmsh_element_type(int number) {
  GmshElementType type;
  int order = 0;
  int nodes = 0;
  int corners = 0;
  std::vector<double> coordinates;
  gmsh::model::mesh::getElementProperties(number, type.name, type.dimension, order, nodes,
                                          coordinates, corners);
  return type;
}

std::string GmshGroup::label() const {
  return "physical " + entity_name(dimension) + " '" + name + "'";
}

std::vector<GmshGroup> gmsh_groups(int dimension, GmshSource source, const GroupNames& names) {
  gmsh::vectorpair tags;
  gmsh::model::getPhysicalGroups(tags, dimension);
  std::sort(tags.begin(), tags.end());
  const bool outside = source == GmshSource::foreign_file;
  if (tags.empty() && outside && dimension >= 2) return groups_by_entity(dimension);
  std::vector<GmshGroup> groups;
  for (const auto& [dim, tag] : tags) {
    GmshGroup group{.dimension = dim, .name = {}, .entities = {}};
    gmsh::model::getPhysicalName(dim, tag, group.name);
    const auto given = names.find({dim, tag});
    if (group.name.empty() && given != names.end()) group.name = given->second;
    if (group.name.empty() && !outside) {
      throw InputError("the script has a physical group without a name: dimension " +
                       std::to_string(dim) + ", tag " + std::to_string(tag) +
                       "; name it, for example Physical Volume(\"part\") = {…}");
    }
    if (group.name.empty()) group.name = entity_name(dim) + "_" + std::to_string(tag);
    gmsh::model::getEntitiesForPhysicalGroup(dim, tag, group.entities);
    add_group(std::move(group), groups);
  }
  return groups;
}

void require_one_part_per_volume(const std::vector<GmshGroup>& volumes) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, 3);
  for (const auto& [dim, tag] : entities) {
    const auto count =
        std::count_if(volumes.begin(), volumes.end(), [entity = tag](const GmshGroup& group) {
          return std::binary_search(group.entities.begin(), group.entities.end(), entity);
        });
    if (count != 1) {
      throw InputError("volume " + std::to_string(tag) + " belongs to " + std::to_string(count) +
                       " physical volumes, expected one");
    }
  }
}

GroupElements elements_of(const GmshGroup& group) {
  GroupElements elements;
  std::map<int, std::size_t> unknown;
  for (const int entity : group.entities) {
    const EntityElements all = elements_of_entity(group.dimension, entity);
    for (std::size_t t = 0; t < all.types.size(); ++t) {
      if (const auto kind = kind_of(all.types[t])) {
        auto& nodes = elements[*kind];
        nodes.insert(nodes.end(), all.nodes[t].begin(), all.nodes[t].end());
      } else {
        unknown[all.types[t]] += all.tags[t].size();
      }
    }
  }
  if (!unknown.empty()) refuse_kinds(group, unknown);
  if (elements.empty()) throw InputError(group.label() + " has no elements");
  return elements;
}

std::vector<std::size_t> node_tags_of(const GmshGroup& group) {
  std::vector<std::size_t> tags;
  for (const int entity : group.entities) {
    append_nodes(elements_of_entity(group.dimension, entity), tags);
  }
  return sorted_once(std::move(tags));
}

std::map<std::string, std::size_t> gmsh_elements_off_volumes() {
  const std::vector<std::size_t> of_volumes = node_tags_in(3);
  const auto is_off = [&](std::size_t node) {
    return !std::binary_search(of_volumes.begin(), of_volumes.end(), node);
  };
  std::map<std::string, std::size_t> off;
  for (const int dimension : {1, 2}) {
    const EntityElements all = elements_of_entity(dimension, kAllEntities);
    for (std::size_t t = 0; t < all.types.size(); ++t) {
      const std::size_t n = all.nodes[t].size() / all.tags[t].size();
      for (auto node = all.nodes[t].begin(); node != all.nodes[t].end();) {
        const auto end = node + static_cast<std::ptrdiff_t>(n);
        if (std::any_of(node, end, is_off)) {
          ++off["elements of type '" + gmsh_element_type(all.types[t]).name +
                "' that are not part of solids"];
        }
        node = end;
      }
    }
  }
  std::vector<std::size_t> nodes;
  std::vector<double> coordinates;
  std::vector<double> parameters;
  gmsh::model::mesh::getNodes(nodes, coordinates, parameters);
  const std::size_t loose =
      sorted_once(std::move(nodes)).size() - node_tags_in(kAllEntities).size();
  if (loose > 0) off["nodes that belong to no element"] = loose;
  return off;
}

}  // namespace flexneck::mesher
