// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/refinement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "mesher/mesh/shape_functions.h"

namespace flexneck::mesher {
namespace {

/// A piece of a reference element: the reference element of a shape under x -> origin + linear x.
struct Piece {
  ReferenceShape shape;
  Eigen::Vector3d origin;
  Eigen::Matrix3d linear;
};

using Points = std::vector<Eigen::Vector3d>;

/// The reference tetrahedron onto the one with these corners, turned right side out.
Piece onto_tetrahedron(Points corners) {
  const auto edges = [&] {
    Eigen::Matrix3d matrix;
    for (int k = 0; k < 3; ++k)
      matrix.col(k) = corners[static_cast<std::size_t>(k) + 1] - corners[0];
    return matrix;
  };
  if (edges().determinant() < 0) std::swap(corners[2], corners[3]);
  return {ReferenceShape::tetrahedron, corners[0], edges()};
}

std::vector<Piece> pieces_of_tetrahedron() {
  const Points corner = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const auto middle = [&](std::size_t a, std::size_t b) -> Eigen::Vector3d {
    return (corner[a] + corner[b]) / 2;
  };
  std::vector<Piece> pieces;
  for (const Eigen::Vector3d& c : corner)
    pieces.push_back({ReferenceShape::tetrahedron, c / 2, Eigen::Matrix3d::Identity() / 2});
  // The octahedron that is left, cut along the diagonal between the middles of edges 02 and 13.
  const Eigen::Vector3d one = middle(0, 2);
  const Eigen::Vector3d other = middle(1, 3);
  const Points ring = {middle(0, 1), middle(0, 3), middle(2, 3), middle(1, 2)};
  for (std::size_t k = 0; k < ring.size(); ++k) {
    pieces.push_back(onto_tetrahedron({one, other, ring[k], ring[(k + 1) % ring.size()]}));
  }
  return pieces;
}

/// Triangles in the plane zeta = 0: three corners, and the middle one turned by half a turn.
std::vector<Piece> pieces_of_triangle() {
  const ReferenceShape shape = ReferenceShape::triangle;
  const Eigen::Matrix3d half = Eigen::Vector3d(0.5, 0.5, 1).asDiagonal();
  const Eigen::Matrix3d turned = Eigen::Vector3d(-0.5, -0.5, 1).asDiagonal();
  return {{shape, {0, 0, 0}, half},
          {shape, {0.5, 0, 0}, half},
          {shape, {0, 0.5, 0}, half},
          {shape, {0.5, 0.5, 0}, turned}};
}

/// Five pyramids at the corners, one upside down under the uppermost, and four tetrahedra.
std::vector<Piece> pieces_of_pyramid() {
  const Eigen::Matrix3d half = Eigen::Matrix3d::Identity() / 2;
  const Eigen::Matrix3d upside_down = Eigen::Vector3d(0.5, -0.5, -0.5).asDiagonal();
  const ReferenceShape shape = ReferenceShape::pyramid;
  std::vector<Piece> pieces = {{shape, {0, 0, 0.5}, half}, {shape, {0, 0, 0.5}, upside_down}};
  const Points corners = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
  const Eigen::Vector3d up(0, 0, 0.5);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector3d& a = corners[k];
    const Eigen::Vector3d& b = corners[(k + 1) % corners.size()];
    pieces.push_back({shape, a, half});
    pieces.push_back(onto_tetrahedron({Eigen::Vector3d::Zero(), a + b, a + up, b + up}));
  }
  return pieces;
}

std::vector<Piece> pieces_of(ReferenceShape shape) {
  std::vector<Piece> pieces;
  switch (shape) {
    case ReferenceShape::hexahedron:
      for (const double z : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) {
          for (const double x : {-0.5, 0.5}) {
            pieces.push_back({shape, {x, y, z}, Eigen::Matrix3d::Identity() / 2});
          }
        }
      }
      break;
    case ReferenceShape::quadrilateral:
      for (const double y : {-0.5, 0.5}) {
        for (const double x : {-0.5, 0.5}) {
          pieces.push_back({shape, {x, y, 0}, Eigen::Matrix3d::Identity() / 2});
        }
      }
      break;
    case ReferenceShape::prism:
      for (const double z : {-0.5, 0.5}) {
        for (Piece piece : pieces_of_triangle()) {
          piece.shape = shape;
          piece.origin[2] = z;
          piece.linear(2, 2) = 0.5;
          pieces.push_back(piece);
        }
      }
      break;
    case ReferenceShape::tetrahedron:
      return pieces_of_tetrahedron();
    case ReferenceShape::pyramid:
      return pieces_of_pyramid();
    case ReferenceShape::triangle:
      return pieces_of_triangle();
  }
  return pieces;
}

/// A position as shape functions that are not zero there: (node, value).
using Weights = std::vector<std::pair<std::int32_t, double>>;

/// Pieces of one kind: row-major (pieces, nodes per element) local positions, or nodes of a mesh.
template <typename Index>
using ByKind = std::map<ElementKind, std::vector<Index>>;

/// How a kind is cut: positions that its pieces have nodes at, and the pieces by positions.
struct Subdivision {
  explicit Subdivision(ElementKind kind);

  std::vector<Weights> positions;  ///< by local nodes
  ByKind<std::size_t> pieces;
};

/// The kind of a piece: that of the whole, or, where the shape differs, of the same order. All
/// tetrahedra of an order have as many nodes on a side as the pyramids that they are cut from.
ElementKind kind_of_piece(ElementKind whole, ReferenceShape shape) {
  if (shape == shape_of(whole)) return whole;
  const auto kinds = element_kinds();
  return *std::find_if(kinds.begin(), kinds.end(), [&](ElementKind kind) {
    return shape_of(kind) == shape && order_of(kind) == order_of(whole);
  });
}

Subdivision::Subdivision(ElementKind kind) {
  constexpr double kNothing = 1e-12;
  std::map<std::array<double, 3>, std::size_t> known;  // coordinates are dyadic, so exact
  Points points;
  for (const Piece& piece : pieces_of(shape_of(kind))) {
    const ElementKind kind_here = kind_of_piece(kind, piece.shape);
    for (const auto& node : reference_nodes(kind_here)) {
      const Eigen::Vector3d x = piece.origin + piece.linear * Eigen::Vector3d(node.data());
      const auto [place, is_new] = known.try_emplace({x[0], x[1], x[2]}, points.size());
      if (is_new) points.push_back(x);
      pieces[kind_here].push_back(place->second);
    }
  }
  Eigen::Matrix3Xd columns(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    columns.col(static_cast<Eigen::Index>(k)) = points[k];
  const Eigen::MatrixXd values = tabulate(kind, columns).values;
  for (const auto& column : values.colwise()) {
    Weights& weights = positions.emplace_back();
    for (Eigen::Index i = 0; i < column.size(); ++i) {
      if (std::abs(column[i]) > kNothing)
        weights.emplace_back(static_cast<std::int32_t>(i), column[i]);
    }
  }
}

/// Numbers positions: neighbours that share a face, an edge or a node know it by the same weights.
class NodeNumbers {
 public:
  explicit NodeNumbers(std::size_t old_count) {
    for (std::size_t k = 0; k < old_count; ++k) {
      weights_.push_back({{static_cast<std::int32_t>(k), 1.0}});
    }
  }

  /// Number of the position, a new one if it is not known.
  std::int32_t number(Weights weights) {
    if (weights.size() == 1) return weights.front().first;
    const auto next = static_cast<std::int32_t>(weights_.size());
    const auto [place, is_new] = numbers_.try_emplace(key_of(weights), next);
    if (is_new) weights_.push_back(std::move(weights));
    return place->second;
  }
  std::optional<std::int32_t> find(const Weights& weights) const {
    if (weights.size() == 1) return weights.front().first;
    const auto found = numbers_.find(key_of(weights));
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }

  const std::vector<Weights>& weights() const { return weights_; }

 private:
  using Key = std::vector<std::int32_t>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::size_t hash = key.size();
      for (const std::int32_t x : key) {
        hash = (hash ^ static_cast<std::size_t>(x)) * 0x9E3779B97F4A7C15ULL;
        hash ^= hash >> 29U;
      }
      return hash;
    }
  };

  /// Nodes by rising number, each with its value in 4096ths: values are multiples of 1/64.
  static Key key_of(Weights weights) {
    std::sort(weights.begin(), weights.end());
    Key key;
    for (const auto& [node, value] : weights) {
      key.push_back(node);
      key.push_back(static_cast<std::int32_t>(std::lround(4096 * value)));
    }
    return key;
  }

  std::unordered_map<Key, std::int32_t, Hash> numbers_;
  std::vector<Weights> weights_;  ///< by number
};

/// Cuts elements or faces of one kind.
ByKind<std::int32_t> cut(ElementKind kind, std::span<const std::int32_t> connectivity,
                         NodeNumbers& numbers) {
  const Subdivision subdivision(kind);
  const std::size_t width = nodes_per_element(kind);
  ByKind<std::int32_t> result;
  std::vector<std::int32_t> here(subdivision.positions.size());
  for (std::size_t first = 0; first < connectivity.size(); first += width) {
    for (std::size_t k = 0; k < here.size(); ++k) {
      Weights weights = subdivision.positions[k];
      for (auto& entry : weights) {
        entry.first = connectivity[first + static_cast<std::size_t>(entry.first)];
      }
      here[k] = numbers.number(std::move(weights));
    }
    for (const auto& [kind_of_pieces, places] : subdivision.pieces)
      for (const std::size_t k : places) result[kind_of_pieces].push_back(here[k]);
  }
  return result;
}

/// Blocks of the finer mesh, and of each block's elements those that they were cut from.
class FinerBlocks {
 public:
  explicit FinerBlocks(Mesh& mesh) : mesh_(mesh) {}

  /// Appends elements of a part to its block of their kind.
  /// @param first_parent, parent_count of which each has as many of them
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

NodeSet refine_set(const NodeSet& set, const std::vector<Weights>& positions) {
  NodeSet result{set.name, {}};
  for (std::size_t k = 0; k < positions.size(); ++k) {
    if (std::all_of(positions[k].begin(), positions[k].end(), [&](const auto& entry) {
          return std::binary_search(set.nodes.begin(), set.nodes.end(), entry.first);
        })) {
      result.nodes.push_back(static_cast<std::int32_t>(k));
    }
  }
  return result;
}

/// New nodes among those of a coupling or support belong to it; masses, springs and equations stay
/// where they are, with reference points behind more nodes.
Connections refine_connections(const Mesh& mesh, const std::vector<Weights>& positions) {
  Connections result = mesh.connections;
  const auto finer = [&](std::vector<std::int32_t>& nodes) {
    nodes = refine_set({"", nodes}, positions).nodes;
  };
  for (Coupling& coupling : result.couplings) finer(coupling.nodes);
  for (Support& support : result.supports) finer(support.nodes);
  const auto behind = [&](std::int32_t& site) {
    if (static_cast<std::size_t>(site) < mesh.nodes.size()) return;
    site += static_cast<std::int32_t>(positions.size() - mesh.nodes.size());
  };
  const auto all_behind = [&](std::vector<Term>& terms) {
    for (Term& term : terms) behind(term.site);
  };
  for (Equation& equation : result.equations) all_behind(equation.terms);
  for (Spring& spring : result.springs) all_behind(spring.terms);
  for (PointMass& mass : result.masses) behind(mass.site);
  return result;
}

/// A position of the lower face becomes one of the upper face when its nodes are exchanged.
Slit refine_slit(const Slit& slit, const NodeNumbers& numbers) {
  std::map<std::int32_t, std::int32_t> partner;
  for (std::size_t p = 0; p < slit.lower.size(); ++p) partner[slit.lower[p]] = slit.upper[p];
  Slit result{slit.name, slit.tied, {}, {}, {}, {}};
  for (std::size_t k = 0; k < numbers.weights().size(); ++k) {
    Weights exchanged = numbers.weights()[k];
    bool is_lower = false;
    for (auto& entry : exchanged) {
      const auto found = partner.find(entry.first);
      if (found == partner.end()) continue;
      entry.first = found->second;
      is_lower = true;
    }
    if (!is_lower) continue;
    if (const auto other = numbers.find(exchanged)) {
      result.lower.push_back(static_cast<std::int32_t>(k));
      result.upper.push_back(*other);
    }
  }
  return result;
}

void place_nodes(const Mesh& before, const std::vector<Weights>& positions, RefinedMesh& result) {
  std::vector<Eigen::Triplet<double, std::int32_t>> entries;
  result.mesh.nodes.reserve(positions.size());
  for (std::size_t k = 0; k < positions.size(); ++k) {
    std::array<double, 3> x{};
    for (const auto& [node, value] : positions[k]) {
      for (std::size_t d = 0; d < 3; ++d) {
        x[d] += value * before.nodes[static_cast<std::size_t>(node)][d];
      }
      entries.emplace_back(static_cast<std::int32_t>(k), node, value);
    }
    result.mesh.nodes.push_back(x);
  }
  result.prolongation.resize(static_cast<Eigen::Index>(positions.size()),
                             static_cast<Eigen::Index>(before.nodes.size()));
  result.prolongation.setFromTriplets(entries.begin(), entries.end());
}

}  // namespace

RefinedMesh refine(const Mesh& mesh) {
  RefinedMesh result;
  NodeNumbers numbers(mesh.nodes.size());
  result.mesh.materials = mesh.materials;
  FinerBlocks blocks(result.mesh);
  std::int32_t first = 0;
  for (const ElementBlock& block : mesh.blocks) {
    for (auto& [kind, nodes] : cut(block.kind, block.nodes, numbers)) {
      nodes.shrink_to_fit();
      blocks.append({block.part, kind, block.material, std::move(nodes)}, first, block.size());
    }
    first += static_cast<std::int32_t>(block.size());
  }
  result.parents = blocks.parents();
  for (const FaceSet& set : mesh.face_sets) {
    FaceSet& refined = result.mesh.face_sets.emplace_back(FaceSet{set.name, {}});
    for (const FaceBlock& block : set.blocks) {
      for (auto& [kind, nodes] : cut(block.kind, block.nodes, numbers))
        refined.blocks.push_back({kind, std::move(nodes)});
    }
  }
  place_nodes(mesh, numbers.weights(), result);
  for (const NodeSet& set : mesh.node_sets) {
    result.mesh.node_sets.push_back(refine_set(set, numbers.weights()));
  }
  for (const Slit& slit : mesh.slits) result.mesh.slits.push_back(refine_slit(slit, numbers));
  result.mesh.connections = refine_connections(mesh, numbers.weights());
  return result;
}

}  // namespace flexneck::mesher
