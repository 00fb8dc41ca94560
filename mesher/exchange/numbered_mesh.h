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

/// A solid element or a face, its nodes given by number in the order of Mesh.
struct NumberedElement {
  std::int64_t number = 0;
  ElementKind kind = ElementKind::hex8;
  std::vector<std::int64_t> nodes;
};

/// Elements with a common name.
struct NumberedGroup {
  std::string name;
  std::vector<NumberedElement> elements;
};

/// The mesh of a file with numbered nodes and elements, without materials.
struct NumberedMesh {
  std::map<std::int64_t, std::array<double, 3>> nodes;  ///< in the file's unit
  std::vector<NumberedGroup> parts;                     ///< groups of solid elements
  std::vector<NumberedGroup> surfaces;                  ///< groups of faces, which must belong to
                                                        ///< solids
  std::map<std::string, std::set<std::int64_t>> node_sets;

  /// @throws InputError if the node was added at another position.
  void add_node(std::int64_t number, const std::array<double, 3>& position);
};

/// A mesh, and the indices of numbered nodes in it.
struct IndexedMesh {
  Mesh mesh;
  std::map<std::int64_t, std::int32_t> index_of;  ///< indices of the nodes that solid elements use
};

/// Builds the mesh: blocks in the order of the parts, one for each kind; the nodes are those of
/// solid elements, by number. Surfaces become face sets, whose faces point outwards, and node sets;
/// nodes that no solid element uses are left out of node sets.
/// @throws InputError for elements with undefined nodes, surfaces that bound no part, parts without
/// material, materials of parts that do not exist.
IndexedMesh indexed_mesh(const NumberedMesh& file, const ImportOptions& options);

}  // namespace flexneck::mesher
