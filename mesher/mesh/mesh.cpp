// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/boundary.h"

namespace flexneck::mesher {
namespace {

/// Tolerance of the normals' length: files may hold them in single precision.
constexpr double kUnitLength = 1e-6;

[[noreturn]] void refuse(const std::string& problem) { throw InputError("mesh: " + problem); }

void check_material(const Material& material) {
  const std::string name = "material '" + material.name + "': ";
  const auto found = [](double value) { return ", found " + exact_text(value); };
  if (!(material.youngs_modulus_Pa > 0 && std::isfinite(material.youngs_modulus_Pa))) {
    refuse(name + "Young's modulus must be > 0" + found(material.youngs_modulus_Pa) + " Pa");
  }
  if (!(material.poissons_ratio > -1 && material.poissons_ratio < 0.5)) {
    refuse(name + "Poisson's ratio must lie between -1 and 0.5" + found(material.poissons_ratio));
  }
  if (!(material.density_kg_m3 > 0 && std::isfinite(material.density_kg_m3))) {
    refuse(name + "density must be > 0" + found(material.density_kg_m3) + " kg/m^3");
  }
}

void check_indices(std::span<const std::int32_t> indices, std::size_t node_count,
                   const std::string& what) {
  if (indices.empty()) refuse(what + " is empty");
  for (const std::int32_t index : indices) {
    if (index < 0 || static_cast<std::size_t>(index) >= node_count) {
      refuse(what + " refers to node " + std::to_string(index) + ", but there are " +
             std::to_string(node_count) + " nodes, counted from 0");
    }
  }
}

/// Checks the node indices of elements or faces of one kind, which has `expected_dimension`.
void check_connectivity(std::span<const std::int32_t> indices, ElementKind kind,
                        int expected_dimension, std::size_t node_count, const std::string& what) {
  if (dimension(kind) != expected_dimension) {
    refuse(what + " has elements of kind " + std::string(name_of(kind)) + ", expected dimension " +
           std::to_string(expected_dimension));
  }
  if (indices.size() % nodes_per_element(kind) != 0) {
    refuse(what + " has " + std::to_string(indices.size()) +
           " node indices, expected a multiple of " + std::to_string(nodes_per_element(kind)));
  }
  check_indices(indices, node_count, what);
}

/// Checks that blocks of one part have the same material and different kinds.
void check_parts(const Mesh& mesh) {
  std::vector<std::string> parts;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    bool is_new = true;
    for (const ElementBlock& other : std::span(mesh.blocks).first(b)) {
      if (other.part != block.part) continue;
      is_new = false;
      if (other.material != block.material) {
        refuse("part '" + block.part + "' has blocks of different materials");
      }
      if (other.kind == block.kind) {
        refuse("part '" + block.part + "' has two blocks of kind " +
               std::string(name_of(block.kind)));
      }
    }
    if (is_new) parts.push_back(block.part);
  }
  check_names(parts, "part");
}

void check_blocks(const Mesh& mesh) {
  if (mesh.blocks.empty()) refuse("expected elements, found none");
  check_parts(mesh);
  std::vector<bool> used(mesh.nodes.size(), false);
  for (const ElementBlock& block : mesh.blocks) {
    const std::string what = "part '" + block.part + "'";
    if (block.material >= mesh.materials.size()) refuse(what + " has no material");
    check_connectivity(block.nodes, block.kind, 3, mesh.nodes.size(), what);
    for (const std::int32_t node : block.nodes) used[static_cast<std::size_t>(node)] = true;
  }
  const auto loose = std::count(used.begin(), used.end(), false);
  if (loose > 0) {
    const auto first = std::find(used.begin(), used.end(), false) - used.begin();
    refuse(std::to_string(loose) + " nodes belong to no element, the first is node " +
           std::to_string(first));
  }
}

void check_sets(const Mesh& mesh) {
  check_names(names_of(mesh.node_sets), "node set");
  for (const NodeSet& set : mesh.node_sets) {
    check_indices(set.nodes, mesh.nodes.size(), "node set '" + set.name + "'");
    if (std::adjacent_find(set.nodes.begin(), set.nodes.end(), std::greater_equal<>()) !=
        set.nodes.end()) {
      refuse("node set '" + set.name + "' is not in ascending order");
    }
  }
  check_names(names_of(mesh.face_sets), "face set");
  for (const FaceSet& set : mesh.face_sets) {
    if (set.blocks.empty()) refuse("face set '" + set.name + "' is empty");
    for (const FaceBlock& block : set.blocks) {
      check_connectivity(block.nodes, block.kind, 2, mesh.nodes.size(),
                         "face set '" + set.name + "'");
    }
  }
}

void check_slit(const Mesh& mesh, const Slit& slit) {
  const std::string what = "slit '" + slit.name + "'";
  check_indices(slit.lower, mesh.nodes.size(), what);
  check_indices(slit.upper, mesh.nodes.size(), what);
  const std::size_t pairs = slit.lower.size();
  if (slit.upper.size() != pairs || slit.normals.size() != pairs || slit.areas_m2.size() != pairs) {
    refuse(what + " has lists of different lengths");
  }
  for (std::size_t p = 0; p < pairs; ++p) {
    const std::int32_t lower = slit.lower[p];
    const std::int32_t upper = slit.upper[p];
    if (lower == upper || mesh.nodes[static_cast<std::size_t>(lower)] !=
                              mesh.nodes[static_cast<std::size_t>(upper)]) {
      refuse(what + " pairs nodes " + std::to_string(lower) + " and " + std::to_string(upper) +
             ", expected two coincident nodes");
    }
    const auto& [x, y, z] = slit.normals[p];
    if (!(std::abs(std::hypot(x, y, z) - 1) <= kUnitLength && std::isfinite(slit.areas_m2[p]))) {
      refuse(what + ": pair " + std::to_string(p) + " must have a unit normal and a finite area");
    }
  }
}

template <class Set>
const Set* find_set(const std::vector<Set>& sets, const std::string& name) {
  const auto found =
      std::find_if(sets.begin(), sets.end(), [&](const Set& set) { return set.name == name; });
  return found == sets.end() ? nullptr : &*found;
}

std::string counted_nodes(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " node" : " nodes");
}

void require_one_meaning(const NodeSet* nodes, const FaceSet* faces) {
  if (nodes == nullptr || faces == nullptr) return;
  const std::vector<std::int32_t> of_faces = nodes_of(*faces).nodes;
  if (of_faces == nodes->nodes) return;
  throw InputError("the node set '" + nodes->name + "' has " + counted_nodes(nodes->nodes.size()) +
                   ", the face set of the same name covers " + counted_nodes(of_faces.size()) +
                   (of_faces.size() == nodes->nodes.size() ? ", but different ones" : "") +
                   "; rename one of them");
}

/// Refuses a node set where faces are needed.
[[noreturn]] void refuse_faces(const Mesh& mesh, const NodeSet& set) {
  const FaceSet faces = faces_among(boundary_facets(mesh), set.name, [&](std::int32_t node) {
    return std::binary_search(set.nodes.begin(), set.nodes.end(), node);
  });
  throw InputError("there is no face set '" + set.name + "': the node set of that name has " +
                   counted_nodes(set.nodes.size()) +
                   ", of which whole faces of the surface cover " +
                   std::to_string(nodes_of(faces).nodes.size()));
}

}  // namespace

const NodeSet& Mesh::node_set(const std::string& name) const {
  require_one_meaning(find_set(node_sets, name), find_set(face_sets, name));
  return node_sets[find_name(names_of(node_sets), name, "node set")];
}

const FaceSet& Mesh::face_set(const std::string& name) const {
  const FaceSet* const faces = find_set(face_sets, name);
  const NodeSet* const same_name = find_set(node_sets, name);
  require_one_meaning(same_name, faces);
  if (faces == nullptr && same_name != nullptr) refuse_faces(*this, *same_name);
  return face_sets[find_name(names_of(face_sets), name, "face set")];
}

std::vector<std::string> parts_of(const Mesh& mesh) {
  std::vector<std::string> parts;
  for (const ElementBlock& block : mesh.blocks) {
    if (std::find(parts.begin(), parts.end(), block.part) == parts.end()) {
      parts.push_back(block.part);
    }
  }
  return parts;
}

NodeSet nodes_of(const FaceSet& faces) {
  NodeSet set{.name = faces.name, .nodes = {}};
  for (const FaceBlock& block : faces.blocks) {
    set.nodes.insert(set.nodes.end(), block.nodes.begin(), block.nodes.end());
  }
  std::sort(set.nodes.begin(), set.nodes.end());
  set.nodes.erase(std::unique(set.nodes.begin(), set.nodes.end()), set.nodes.end());
  return set;
}

void check(const Mesh& mesh) {
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
    for (const double x : mesh.nodes[n]) {
      if (!std::isfinite(x)) refuse("node " + std::to_string(n) + " has no finite position");
    }
  }
  check_names(names_of(mesh.materials), "material");
  for (const Material& material : mesh.materials) check_material(material);
  check_blocks(mesh);
  check_sets(mesh);
  check_names(names_of(mesh.slits), "slit");
  for (const Slit& slit : mesh.slits) check_slit(mesh, slit);
  try {
    check(mesh.connections, mesh.nodes.size());
  } catch (const InputError& error) {
    refuse(error.what());
  }
}

}  // namespace flexneck::mesher
