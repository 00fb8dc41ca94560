// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "mesher/exchange/import_options.h"
#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// A solid element or a face, its nodes by number in the order of Mesh.
struct NumberedElement {
  std::int64_t number = 0;
  ElementKind kind = ElementKind::hex8;
  std::vector<std::int64_t> nodes;
};

/// Under a name.
struct NumberedGroup {
  std::string name;
  std::vector<NumberedElement> elements;
};

/// The mesh of a file with numbered nodes and elements, without materials.
struct NumberedMesh {
  std::map<std::int64_t, std::array<double, 3>> nodes;  ///< in the file's unit
  std::vector<NumberedGroup> parts;                     ///< of solid elements
  std::vector<NumberedGroup> surfaces;                  ///< of faces, which solids have too
  std::map<std::string, std::set<std::int64_t>> node_sets;

  /// @throws InputError if the node has come in another place.
  void add_node(std::int64_t number, const std::array<double, 3>& position);
};

/// A mesh, and where its nodes stand in it.
struct IndexedMesh {
  Mesh mesh;
  std::map<std::int64_t, std::int32_t> index_of;  ///< of the nodes that solid elements use
};

/// Blocks in the order of the parts, one for each kind; nodes are those of solid elements, by
/// number. Surfaces are face sets, whose faces point outwards, and node sets; nodes that no solid
/// element uses are left out of node sets.
/// @throws InputError for elements with nodes that are not there, surfaces that bound no part,
/// parts without material, materials of parts that are not there.
IndexedMesh indexed_mesh(const NumberedMesh& file, const ImportOptions& options);

}  // namespace flexneck::mesher
