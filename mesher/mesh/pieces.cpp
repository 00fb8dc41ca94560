// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/mesh/pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "mesher/mesh/boundary.h"
#include "mesher/mesh/bounding_box.h"
#include "mesher/mesh/positions.h"

namespace flexneck::mesher {
namespace {

/// Tolerance, as a fraction of the size, by which corners may cross a plane that passes between
/// elements.
constexpr double kOnPlane = 1e-6;

/// Lowest and highest offset of an element's corners along the normal.
std::pair<double, double> extent_along(const Mesh& mesh, const Eigen::Vector3d& normal,
                                       std::span<const std::int32_t> corners) {
  std::pair<double, double> extent = {HUGE_VAL, -HUGE_VAL};
  const auto positions = positions_of(mesh);
  for (const std::int32_t node : corners) {
    const double offset = normal.dot(positions.col(node));
    extent = {std::min(extent.first, offset), std::max(extent.second, offset)};
  }
  return extent;
}

/// Adds the sets and slits of the whole mesh to one submesh.
class PieceBuilder {
 public:
  PieceBuilder(const Mesh& whole, const PieceOfElement& piece_of_element, std::int32_t piece)
      : result_(submesh(whole, piece_of_element, piece)), number_(whole.nodes.size(), -1) {
    for (std::size_t n = 0; n < result_.nodes.size(); ++n) {
      number_[static_cast<std::size_t>(result_.nodes[n])] = static_cast<std::int32_t>(n);
    }
  }

  bool has(std::span<const std::int32_t> nodes) const {
    return std::all_of(nodes.begin(), nodes.end(), [&](std::int32_t n) { return of(n) >= 0; });
  }

  /// Adds a face set, unless the submesh has more nodes in the node set of its name: those at the
  /// edge of faces of other submeshes.
  void add_faces(FaceSet faces) {
    for (FaceBlock& block : faces.blocks) renumber(block.nodes);
    const std::vector<NodeSet>& sets = result_.mesh.node_sets;
    if (std::none_of(sets.begin(), sets.end(), [&](const NodeSet& set) {
          return set.name == faces.name && set.nodes != nodes_of(faces).nodes;
        })) {
      result_.mesh.face_sets.push_back(std::move(faces));
    }
  }

  /// Adds those nodes of the set that belong to the submesh.
  void add_nodes(const NodeSet& set) {
    NodeSet own{.name = set.name, .nodes = {}};
    for (const std::int32_t node : set.nodes) {
      if (of(node) >= 0) own.nodes.push_back(of(node));
    }
    if (!own.nodes.empty()) result_.mesh.node_sets.push_back(std::move(own));
  }

  void add_slit(Slit slit) {
    if (!has(slit.lower) && !has(slit.upper)) return;
    if (!has(slit.lower) || !has(slit.upper)) {
      throw InputError("slit '" + slit.name +
                       "' lies between two substructures; use another cutting plane");
    }
    renumber(slit.lower);
    renumber(slit.upper);
    result_.mesh.slits.push_back(std::move(slit));
  }

  MeshPiece take() { return std::move(result_); }

 private:
  std::int32_t of(std::int32_t node) const { return number_[static_cast<std::size_t>(node)]; }

  void renumber(std::vector<std::int32_t>& nodes) const {
    for (std::int32_t& node : nodes) node = of(node);
  }

  MeshPiece result_;
  std::vector<std::int32_t> number_;  ///< index in the submesh, by node of the whole; -1 outside
};

/// The faces of a set whose nodes all belong to the submesh.
FaceSet faces_of_piece(const FaceSet& set, const PieceBuilder& piece) {
  FaceSet own{.name = set.name, .blocks = {}};
  for (const FaceBlock& block : set.blocks) {
    const std::size_t n = nodes_per_element(block.kind);
    FaceBlock kept{block.kind, {}};
    for (std::size_t f = 0; f < block.size(); ++f) {
      const auto nodes = std::span(block.nodes).subspan(f * n, n);
      if (piece.has(nodes)) kept.nodes.insert(kept.nodes.end(), nodes.begin(), nodes.end());
    }
    if (!kept.nodes.empty()) own.blocks.push_back(std::move(kept));
  }
  return own;
}

/// Common faces of each pair of submeshes; normals point out of the first.
using CommonFaces = std::map<std::pair<std::int32_t, std::int32_t>, std::vector<Facet>>;

CommonFaces common_faces(const Mesh& mesh, const PieceOfElement& piece_of_element) {
  CommonFaces common;
  const std::vector<FacetPlace> sides = facets_by_key(mesh);
  for (std::size_t s = 1; s < sides.size(); ++s) {
    const std::int32_t a = piece_of_element[sides[s - 1].number];
    const std::int32_t b = piece_of_element[sides[s].number];
    if (sides[s].key != sides[s - 1].key || a == b) continue;
    common[{a, b}].push_back(facet_at(mesh, sides[s - 1]));
    common[{b, a}].push_back(facet_at(mesh, sides[s]));
  }
  return common;
}

}  // namespace

PieceOfElement pieces_by_parts(const Mesh& mesh,
                               const std::vector<std::vector<std::string>>& parts) {
  const std::vector<std::string> names = parts_of(mesh);
  std::vector<std::int32_t> piece_of_part(names.size(), -1);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (const std::string& part : parts[p]) {
      std::int32_t& piece = piece_of_part[find_name(names, part, "part")];
      if (piece >= 0) throw InputError("part '" + part + "' belongs to two substructures");
      piece = static_cast<std::int32_t>(p);
    }
  }
  PieceOfElement result;
  for (const ElementBlock& block : mesh.blocks) {
    const std::int32_t piece = piece_of_part[find_name(names, block.part, "part")];
    if (piece < 0) throw InputError("part '" + block.part + "' belongs to no substructure");
    result.insert(result.end(), block.size(), piece);
  }
  return result;
}

PieceOfElement pieces_by_planes(const Mesh& mesh, const Eigen::Vector3d& normal,
                                std::span<const double> offsets_m) {
  if (std::adjacent_find(offsets_m.begin(), offsets_m.end(), std::greater_equal<>()) !=
      offsets_m.end()) {
    throw InputError("the cutting planes must be in ascending order along their normal");
  }
  const double tolerance = kOnPlane * bounding_box(mesh).extent_m().norm();
  PieceOfElement result;
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t width = nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e) {
      const auto [low, high] = extent_along(
          mesh, normal, std::span(block.nodes).subspan(e * width, corners_per_element(block.kind)));
      const auto piece = std::lower_bound(offsets_m.begin(), offsets_m.end(), low + tolerance);
      if (piece != offsets_m.end() && high > *piece + tolerance) {
        throw InputError("the plane at " + exact_text(*piece) +
                         " m passes through elements of part '" + block.part +
                         "'; use a plane between layers of elements");
      }
      result.push_back(static_cast<std::int32_t>(piece - offsets_m.begin()));
    }
  }
  for (std::size_t p = 0; p <= offsets_m.size(); ++p) {
    if (std::find(result.begin(), result.end(), static_cast<std::int32_t>(p)) == result.end()) {
      throw InputError("the cutting planes leave substructure " + std::to_string(p + 1) +
                       " without elements");
    }
  }
  return result;
}

std::string cut_name(const std::string& other_piece) { return "to_" + other_piece; }

std::vector<MeshPiece> cut_apart(const Mesh& mesh, const PieceOfElement& piece_of_element,
                                 const std::vector<std::string>& names) {
  if (!mesh.connections.empty()) {
    throw InputError("a structure with " + mesh.connections.text() +
                     " cannot be divided into substructures; remove them");
  }
  const CommonFaces common = common_faces(mesh, piece_of_element);
  std::vector<MeshPiece> pieces;
  for (std::size_t p = 0; p < names.size(); ++p) {
    const auto piece = static_cast<std::int32_t>(p);
    PieceBuilder builder(mesh, piece_of_element, piece);
    for (const NodeSet& set : mesh.node_sets) builder.add_nodes(set);
    for (const FaceSet& set : mesh.face_sets) {
      FaceSet own = faces_of_piece(set, builder);
      if (!own.blocks.empty()) builder.add_faces(std::move(own));
    }
    for (const auto& [pair, sides] : common) {
      if (pair.first != piece) continue;
      FaceSet cut = faces_among(sides, cut_name(names[static_cast<std::size_t>(pair.second)]),
                                [](std::int32_t) { return true; });
      builder.add_nodes(nodes_of(cut));
      builder.add_faces(std::move(cut));
    }
    for (const Slit& slit : mesh.slits) builder.add_slit(slit);
    pieces.push_back(builder.take());
  }
  return pieces;
}

}  // namespace flexneck::mesher
