// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// Origin of gmsh's current model. The author of a script names groups; an imported mesh may have
/// none, or groups without names.
enum class GmshSource { script, foreign_file };

/// An element type by gmsh's number.
struct GmshElementType {
  std::string name;
  int dimension = 0;
};
/// The element type of a number. Throws gmsh's exception if gmsh does not know it.
GmshElementType gmsh_element_type(int number);

/// Entities of gmsh's model with a common name.
struct GmshGroup {
  int dimension = 0;
  std::string name;
  std::vector<int> entities;  ///< ascending

  std::string label() const;  ///< "physical volume 'part'"
};

/// Names of physical groups by dimension and tag.
using GroupNames = std::map<std::pair<int, int>, std::string>;

/// Physical groups of a dimension in the order of their tags; those of the same name are merged. In
/// a foreign file, a group without a name is called "volume_<tag>" (surface, curve, point), and if
/// there is no group of volumes or surfaces at all, each entity with elements counts as one.
/// @param names of groups whose names gmsh has lost
/// @throws InputError if a script's group has no name.
std::vector<GmshGroup> gmsh_groups(int dimension, GmshSource source, const GroupNames& names);

/// Checks that every volume belongs to exactly one group: material would be lost or counted twice.
/// @throws InputError otherwise.
void require_one_part_per_volume(const std::vector<GmshGroup>& volumes);

/// Node tags of a group's elements, row-major (elements, nodes per element), by kind.
using GroupElements = std::map<ElementKind, std::vector<std::size_t>>;
/// Elements of a group by kind.
/// @throws InputError if the group has no elements, or elements of a kind that a mesh cannot hold:
/// which, and how many.
GroupElements elements_of(const GmshGroup& group);

/// Node tags of a group's elements of any kind, ascending.
std::vector<std::size_t> node_tags_of(const GmshGroup& group);

/// Numbers of items of gmsh's model that do not belong to its volumes: elements of curves and
/// surfaces with a node that no volume element has, by the name of their type, and nodes of no
/// element.
std::map<std::string, std::size_t> gmsh_elements_off_volumes();

}  // namespace flexneck::mesher
