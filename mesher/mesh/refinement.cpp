// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/refinement.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "mesher/mesh/refined_nodes.h"
#include "mesher/mesh/subdivision.h"

namespace flexneck::mesher {
namespace {

/// Makes elements or faces of one kind finer.
ByKind<std::int32_t> finer_elements(const Subdivision& subdivision,
                                    std::span<const std::int32_t> connectivity,
                                    RefinedNodes& refined) {
  const std::size_t width = nodes_per_element(subdivision.kind);
  ByKind<std::int32_t> result;
  std::vector<std::int32_t> here(subdivision.positions.size());
  for (std::size_t first = 0; first < connectivity.size(); first += width) {
    const std::int32_t* const element = connectivity.data() + first;
    for (std::size_t k = 0; k < here.size(); ++k) {
      here[k] = refined.number({subdivision.positions[k], element});
    }
    for (const auto& [kind_of_pieces, places] : subdivision.pieces)
      for (const std::size_t k : places) result[kind_of_pieces].push_back(here[k]);
  }
  return result;
}

/// Blocks of the finer mesh, with the parent of each of their elements.
class FinerBlocks {
 public:
  explicit FinerBlocks(Mesh& mesh) : mesh_(mesh) {}

  /// Appends elements of a part to its block of their kind.
  /// @param first_parent, parent_count consecutive parents, each with equally many of the elements
  void append(ElementBlock added, std::int32_t first_parent, std::size_t parent_count) {
    const std::size_t pieces = added.size() / parent_count;
    auto found = std::find_if(mesh_.blocks.begin(), mesh_.blocks.end(), [&](const auto& block) {
      return block.part == added.part && block.kind == added.kind;
    });
    const auto place = static_cast<std::size_t>(found - mesh_.blocks.begin());
    if (found == mesh_.blocks.end()) {
      mesh_.blocks.push_back(std::move(added));
      parents_.emplace_back();
    } else {
      found->nodes.insert(found->nodes.end(), added.nodes.begin(), added.nodes.end());
    }
    for (std::size_t k = 0; k < parent_count; ++k) {
      parents_[place].insert(parents_[place].end(), pieces,
                             first_parent + static_cast<std::int32_t>(k));
    }
  }
  std::vector<std::int32_t> parents() const {
    std::vector<std::int32_t> all;
    for (const auto& block : parents_) all.insert(all.end(), block.begin(), block.end());
    return all;
  }

 private:
  Mesh& mesh_;
  std::vector<std::vector<std::int32_t>> parents_;
};

/// The nodes whose weights all belong to nodes of the set.
NodeSet refine_set(const NodeSet& set, const RefinedNodes& refined) {
  NodeSet result{set.name, {}};
  std::vector<NodeWeight> weights;
  for (std::size_t k = 0; k < refined.size(); ++k) {
    refined.find_weights(k, weights);
    if (std::all_of(weights.begin(), weights.end(), [&](const NodeWeight& weight) {
          return std::binary_search(set.nodes.begin(), set.nodes.end(), weight.node);
        })) {
      result.nodes.push_back(static_cast<std::int32_t>(k));
    }
  }
  return result;
}

/// Returns whether a face set of the same name has the same nodes; it then also has them in the
/// finer mesh.
bool is_of_faces(const Mesh& mesh, const NodeSet& set) {
  return std::any_of(mesh.face_sets.begin(), mesh.face_sets.end(), [&](const FaceSet& faces) {
    return faces.name == set.name && nodes_of(faces).nodes == set.nodes;
  });
}

/// Connections of the finer mesh. New nodes among those of a coupling or support belong to it;
/// masses, springs and equations keep their sites, with reference points numbered after more nodes.
Connections refine_connections(const Mesh& mesh, const RefinedNodes& refined) {
  Connections result = mesh.connections;
  const auto finer = [&](std::vector<std::int32_t>& nodes) {
    nodes = refine_set({"", nodes}, refined).nodes;
  };
  for (Coupling& coupling : result.couplings) finer(coupling.nodes);
  for (Support& support : result.supports) finer(support.nodes);
  const auto behind = [&](std::int32_t& site) {
    if (static_cast<std::size_t>(site) < mesh.nodes.size()) return;
    site += static_cast<std::int32_t>(refined.size() - mesh.nodes.size());
  };
  const auto all_behind = [&](std::vector<Term>& terms) {
    for (Term& term : terms) behind(term.site);
  };
  for (Equation& equation : result.equations) all_behind(equation.terms);
  for (Spring& spring : result.springs) all_behind(spring.terms);
  for (PointMass& mass : result.masses) behind(mass.site);
  return result;
}

/// Refines a slit. Exchanging lower for upper nodes turns a position on the lower face into its
/// partner on the upper face.
Slit refine_slit(const Slit& slit, const RefinedNodes& refined) {
  std::map<std::int32_t, std::int32_t> partner;
  for (std::size_t p = 0; p < slit.lower.size(); ++p) partner[slit.lower[p]] = slit.upper[p];
  Slit result{slit.name, slit.tied, {}, {}, {}, {}};
  std::vector<NodeWeight> exchanged;
  for (std::size_t k = 0; k < refined.size(); ++k) {
    refined.find_weights(k, exchanged);
    bool is_lower = false;
    for (NodeWeight& weight : exchanged) {
      const auto found = partner.find(weight.node);
      if (found == partner.end()) continue;
      weight.node = found->second;
      is_lower = true;
    }
    if (!is_lower) continue;
    if (const auto other = refined.find({exchanged})) {
      result.lower.push_back(static_cast<std::int32_t>(k));
      result.upper.push_back(*other);
    }
  }
  return result;
}

void place_nodes(const Mesh& before, const RefinedNodes& refined, RefinedMesh& result) {
  const auto rows = static_cast<Eigen::Index>(refined.size());
  result.prolongation.resize(rows, static_cast<Eigen::Index>(before.nodes.size()));
  result.prolongation.reserve(static_cast<Eigen::Index>(refined.weight_count()));
  result.mesh.nodes.reserve(refined.size());
  std::vector<NodeWeight> weights;
  for (Eigen::Index row = 0; row < rows; ++row) {
    refined.find_weights(static_cast<std::size_t>(row), weights);
    std::array<double, 3> x{};
    for (const auto& [node, value] : weights) {
      for (std::size_t d = 0; d < 3; ++d) {
        x[d] += value * before.nodes[static_cast<std::size_t>(node)][d];
      }
    }
    result.mesh.nodes.push_back(x);
    std::sort(weights.begin(), weights.end(),
              [](const NodeWeight& a, const NodeWeight& b) { return a.node < b.node; });
    result.prolongation.startVec(row);
    for (const auto& [node, value] : weights) result.prolongation.insertBack(row, node) = value;
  }
  result.prolongation.finalize();
}

RefinedMesh finer_mesh(const Mesh& mesh, Finer how) {
  RefinedMesh result;
  std::map<ElementKind, Subdivision> subdivisions;  // new nodes keep references to them
  RefinedNodes refined(mesh.nodes.size());
  const auto pieces_of = [&](ElementKind kind, std::span<const std::int32_t> connectivity) {
    return finer_elements(subdivisions.try_emplace(kind, kind, how).first->second, connectivity,
                          refined);
  };
  result.mesh.materials = mesh.materials;
  FinerBlocks blocks(result.mesh);
  std::int32_t first = 0;
  for (const ElementBlock& block : mesh.blocks) {
    for (auto& [kind, nodes] : pieces_of(block.kind, block.nodes)) {
      nodes.shrink_to_fit();
      blocks.append({block.part, kind, block.material, std::move(nodes)}, first, block.size());
    }
    first += static_cast<std::int32_t>(block.size());
  }
  result.parents = blocks.parents();
  for (const FaceSet& set : mesh.face_sets) {
    FaceSet& finer = result.mesh.face_sets.emplace_back(FaceSet{set.name, {}});
    for (const FaceBlock& block : set.blocks) {
      for (auto& [kind, nodes] : pieces_of(block.kind, block.nodes))
        finer.blocks.push_back({kind, std::move(nodes)});
    }
  }
  place_nodes(mesh, refined, result);
  for (const NodeSet& set : mesh.node_sets) {
    result.mesh.node_sets.push_back(is_of_faces(mesh, set)
                                        ? nodes_of(result.mesh.face_set(set.name))
                                        : refine_set(set, refined));
  }
  for (const Slit& slit : mesh.slits) result.mesh.slits.push_back(refine_slit(slit, refined));
  result.mesh.connections = refine_connections(mesh, refined);
  return result;
}

}  // namespace

RefinedMesh refine(const Mesh& mesh) { return finer_mesh(mesh, Finer::cut); }

RefinedMesh raise_order(const Mesh& mesh) { return finer_mesh(mesh, Finer::raise); }

}  // namespace flexneck::mesher
