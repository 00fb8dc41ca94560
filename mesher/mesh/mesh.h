// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// Linear elastic, isotropic.
struct Material {
  std::string name;
  double youngs_modulus_Pa = 0;
  double poissons_ratio = 0;
  double density_kg_m3 = 0;
};

/// The elements of one part, all of one kind and one material.
struct ElementBlock {
  std::string part;  ///< e.g. "plate_2", unique within the mesh
  ElementKind kind = ElementKind::hex27;
  std::size_t material = 0;         ///< index into Mesh::materials
  std::vector<std::int32_t> nodes;  ///< row-major (elements, nodes per element)

  std::size_t size() const { return nodes.size() / nodes_per_element(kind); }
};

/// Nodes by name, ascending.
struct NodeSet {
  std::string name;
  std::vector<std::int32_t> nodes;
};

/// Faces of volume elements by name.
struct FaceSet {
  std::string name;
  ElementKind kind = ElementKind::quad9;
  std::vector<std::int32_t> nodes;  ///< row-major (faces, nodes per face)
};

/// A conforming mesh with its materials and sets. Lengths in m, in the frame of the geometry.
struct Mesh {
  std::vector<std::array<double, 3>> nodes;
  std::vector<Material> materials;
  std::vector<ElementBlock> blocks;
  std::vector<NodeSet> node_sets;
  std::vector<FaceSet> face_sets;

  /// @throws InputError if there is none of that name; the message lists those there are.
  const NodeSet& node_set(const std::string& name) const;
  const FaceSet& face_set(const std::string& name) const;
};

/// Checks what every consumer relies on: indices in range, no loose node, no empty block or set,
/// unique names, materials physical (E > 0, -1 < nu < 0.5, density > 0).
/// @throws InputError naming the first violation.
void check(const Mesh& mesh);

}  // namespace flexneck::mesher
