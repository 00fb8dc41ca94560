// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/exchange/numbered_mesh.h"

#include <algorithm>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "mesher/exchange/part_materials.h"
#include "mesher/mesh/face_orientation.h"

namespace flexneck::mesher {
namespace {

class Builder {
 public:
  Builder(const NumberedMesh& file, const ImportOptions& options)
      : file_(file), options_(options) {}

  IndexedMesh build() {
    if (file_.parts.empty()) throw InputError("expected volume elements, found none");
    require_known_parts(names_of(file_.parts), options_.material_of_part);
    number_nodes();
    mesh().materials = options_.materials;
    for (const NumberedGroup& part : file_.parts) add_part(part);
    for (const NumberedGroup& surface : file_.surfaces) add_surface(surface);
    for (const auto& [name, numbers] : file_.node_sets) add_nodes(name, numbers);
    return std::move(result_);
  }

 private:
  Mesh& mesh() { return result_.mesh; }

  void number_nodes() {
    for (const NumberedGroup& part : file_.parts) {
      for (const NumberedElement& element : part.elements) {
        for (const std::int64_t node : element.nodes) {
          if (file_.nodes.count(node) == 0) {
            throw InputError("element " + std::to_string(element.number) + " has node " +
                             std::to_string(node) + ", which the file does not define");
          }
          result_.index_of[node] = 0;
        }
      }
    }
    std::int32_t next = 0;
    for (auto& [number, index] : result_.index_of) {
      index = next++;
      std::array<double, 3> x = file_.nodes.at(number);
      for (double& coordinate : x) coordinate *= options_.length_unit_m;
      mesh().nodes.push_back(x);
    }
  }

  void add_part(const NumberedGroup& part) {
    const std::size_t material =
        material_index(part.name, options_.materials, options_.material_of_part);
    std::map<ElementKind, std::vector<std::int32_t>> by_kind;
    for (const NumberedElement& element : part.elements) {
      std::vector<std::int32_t>& nodes = by_kind[element.kind];
      for (const std::int64_t node : element.nodes) nodes.push_back(result_.index_of.at(node));
    }
    for (auto& [kind, nodes] : by_kind) {
      mesh().blocks.push_back({part.name, kind, material, std::move(nodes)});
    }
  }

  void add_surface(const NumberedGroup& surface) {
    std::map<ElementKind, FaceBlock> by_kind;
    for (const NumberedElement& face : surface.elements) {
      FaceBlock& block = by_kind.try_emplace(face.kind, FaceBlock{face.kind, {}}).first->second;
      for (const std::int64_t node : face.nodes) {
        const auto found = result_.index_of.find(node);
        if (found == result_.index_of.end()) {
          throw InputError("surface '" + surface.name + "': element " +
                           std::to_string(face.number) + " is on the boundary of no part");
        }
        block.nodes.push_back(found->second);
      }
    }
    FaceSet set{surface.name, {}};
    for (auto& [kind, block] : by_kind) {
      orient_outwards(mesh(), surface.name, block);
      set.blocks.push_back(std::move(block));
    }
    mesh().node_sets.push_back(nodes_of(set));
    mesh().face_sets.push_back(std::move(set));
  }

  /// Adds a node set. Nodes under the name of a surface join the surface's nodes.
  void add_nodes(const std::string& name, const std::set<std::int64_t>& numbers) {
    std::set<std::int32_t> nodes;
    for (const std::int64_t number : numbers) {
      const auto found = result_.index_of.find(number);
      if (found != result_.index_of.end()) nodes.insert(found->second);
    }
    const auto known = std::find_if(mesh().node_sets.begin(), mesh().node_sets.end(),
                                    [&](const NodeSet& set) { return set.name == name; });
    if (known != mesh().node_sets.end()) {
      nodes.insert(known->nodes.begin(), known->nodes.end());
      known->nodes.assign(nodes.begin(), nodes.end());
    } else if (!nodes.empty()) {
      mesh().node_sets.push_back({name, {nodes.begin(), nodes.end()}});
    }
  }

  const NumberedMesh& file_;
  const ImportOptions& options_;
  IndexedMesh result_;
};

}  // namespace

void NumberedMesh::add_node(std::int64_t number, const std::array<double, 3>& position) {
  const auto [entry, is_new] = nodes.emplace(number, position);
  if (is_new || entry->second == position) return;
  throw InputError("node " + std::to_string(number) + " is defined twice, at different positions");
}

IndexedMesh indexed_mesh(const NumberedMesh& file, const ImportOptions& options) {
  return Builder(file, options).build();
}

}  // namespace flexneck::mesher
