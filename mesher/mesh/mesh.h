// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "mesher/mesh/connections.h"
#include "mesher/mesh/element_kind.h"

namespace flexneck::mesher {

/// A linear elastic, isotropic material.
struct Material {
  std::string name;
  double youngs_modulus_Pa = 0;
  double poissons_ratio = 0;
  double density_kg_m3 = 0;
};

/// Elements of one part and of one kind, all of one material. A part with elements of several kinds
/// has a block for each.
struct ElementBlock {
  std::string part;  ///< e.g. "plate_2"
  ElementKind kind = ElementKind::hex27;
  std::size_t material = 0;         ///< index into Mesh::materials
  std::vector<std::int32_t> nodes;  ///< row-major (elements, nodes per element)

  std::size_t size() const { return nodes.size() / nodes_per_element(kind); }
};

/// A named set of nodes, ascending.
struct NodeSet {
  std::string name;
  std::vector<std::int32_t> nodes;
};

/// Faces of one kind.
struct FaceBlock {
  ElementKind kind = ElementKind::quad9;
  std::vector<std::int32_t> nodes;  ///< row-major (faces, nodes per face)

  std::size_t size() const { return nodes.size() / nodes_per_element(kind); }
};

/// A named set of faces of volume elements, a block for each kind that occurs.
struct FaceSet {
  std::string name;
  std::vector<FaceBlock> blocks;
};

/// A cut of zero width through a part: its two faces have nodes of their own, which coincide in
/// pairs.
struct Slit {
  std::string name;
  bool tied = false;                ///< the two nodes of a pair move as one: a closed cut
  std::vector<std::int32_t> lower;  ///< (p) nodes of the face from which the normals point
  std::vector<std::int32_t> upper;  ///< (p) their partners on the other face
  std::vector<std::array<double, 3>> normals;  ///< (p) unit, from lower to upper
  std::vector<double> areas_m2;                ///< (p) int N dA of each node; the tip has the rest
};

/// A conforming mesh with its materials and sets. Lengths in m, in the frame of the geometry.
struct Mesh {
  std::vector<std::array<double, 3>> nodes;
  std::vector<Material> materials;
  std::vector<ElementBlock> blocks;
  std::vector<NodeSet> node_sets;
  std::vector<FaceSet> face_sets;
  std::vector<Slit> slits;
  Connections connections;

  /// The node set of a name, or the nodes of the face set of that name.
  /// @throws InputError if there is none of that name, with a list of the existing names; if a node
  /// set and a face set of that name have different nodes, with both counts.
  const NodeSet& node_set(const std::string& name) const;
  const FaceSet& face_set(const std::string& name) const;
};

/// The names of the parts, each once, in the order of the blocks.
std::vector<std::string> parts_of(const Mesh& mesh);

/// The nodes of a face set under its name, ascending.
NodeSet nodes_of(const FaceSet& faces);

/// Checks that indices are in range, every node has an element, no block or set is empty, names are
/// unique, each part has one material, paired nodes coincide and have a unit normal, materials are
/// physical (E > 0, -1 < nu < 0.5, density > 0) and connections pass check(Connections).
/// @throws InputError naming the first violation.
void check(const Mesh& mesh);

}  // namespace flexneck::mesher
