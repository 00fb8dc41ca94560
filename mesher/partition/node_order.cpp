// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/partition/node_order.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>

#include "mesher/partition/corner_lists.h"
#include "mesher/partition/metis.h"

namespace flexneck::mesher {
namespace {

static_assert(std::is_same_v<idx_t, std::int32_t>, "METIS must have 32-bit indices");

/// Elimination order of a graph without loops.
/// @param offsets, columns  in compressed rows; METIS takes them as not const but leaves them
/// unchanged
std::vector<std::int32_t> order_without_loops(idx_t vertices, idx_t* offsets, idx_t* columns) {
  MetisOptions options = metis_options();
  std::vector<std::int32_t> order(static_cast<std::size_t>(vertices));
  std::vector<std::int32_t> place(order.size());
  require_metis(METIS_NodeND(&vertices, offsets, columns, nullptr, options.data(), order.data(),
                             place.data()),
                "ordering by nested dissection");
  return order;
}

/// Representative of each node: the node itself, or the lower node of a tied pair for its upper
/// one.
std::vector<std::int32_t> representatives(const Mesh& mesh) {
  std::vector<std::int32_t> stand_in(mesh.nodes.size());
  std::iota(stand_in.begin(), stand_in.end(), 0);
  for (const Slit& slit : mesh.slits) {
    if (!slit.tied) continue;
    for (std::size_t p = 0; p < slit.lower.size(); ++p) {
      stand_in[static_cast<std::size_t>(slit.upper[p])] = slit.lower[p];
    }
  }
  return stand_in;
}

/// Corners of the elements, numbered without gaps.
class CornerGraph {
 public:
  CornerGraph(const Mesh& mesh, std::vector<std::int32_t> stand_in)
      : stand_in_(std::move(stand_in)), number_(mesh.nodes.size(), -1), lists_(corner_lists(mesh)) {
    for (idx_t& node : lists_.corners) {
      std::int32_t& number = number_of(node);
      if (number < 0) number = count_++;
      node = number;
    }
  }

  idx_t corner_count() const { return count_; }
  /// Number of a corner node.
  std::int32_t corner(std::int32_t node) const {
    return number_[static_cast<std::size_t>(stand_in_[static_cast<std::size_t>(node)])];
  }
  const CornerLists& elements() const { return lists_; }

 private:
  std::int32_t& number_of(std::int32_t node) {
    return number_[static_cast<std::size_t>(stand_in_[static_cast<std::size_t>(node)])];
  }

  std::vector<std::int32_t> stand_in_;
  std::vector<std::int32_t> number_;
  CornerLists lists_;
  idx_t count_ = 0;
};

/// Position of each corner in the elimination order of the corners.
std::vector<std::int32_t> places_of_corners(const CornerGraph& graph) {
  CornerLists lists = graph.elements();
  auto element_count = static_cast<idx_t>(lists.offsets.size()) - 1;
  idx_t corner_count = graph.corner_count();
  idx_t from_zero = 0;
  idx_t* graph_offsets = nullptr;
  idx_t* graph_columns = nullptr;
  require_metis(METIS_MeshToNodal(&element_count, &corner_count, lists.offsets.data(),
                                  lists.corners.data(), &from_zero, &graph_offsets, &graph_columns),
                "finding the neighbours of the corners");
  const MetisArray own_offsets(graph_offsets);
  const MetisArray own_columns(graph_columns);
  const std::vector<std::int32_t> order =
      order_without_loops(corner_count, own_offsets.get(), own_columns.get());
  std::vector<std::int32_t> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
  }
  return place;
}

/// For each node of an element, the corners of the edge, face or body in whose middle it lies; for
/// a corner, itself.
std::vector<std::vector<std::size_t>> defining_corners(ElementKind kind) {
  const std::size_t corner_count = corners_per_element(kind);
  std::vector<std::vector<std::size_t>> result(nodes_per_element(kind));
  for (std::size_t node = 0; node < result.size(); ++node) {
    // The corners that lie on every facet on which the node lies.
    std::vector<bool> on_all(corner_count, true);
    for (const ReferenceFacet& side : facets_of(kind)) {
      const auto has = [&](std::size_t other) {
        return std::find(side.nodes.begin(), side.nodes.end(), other) != side.nodes.end();
      };
      if (!has(node)) continue;
      for (std::size_t c = 0; c < corner_count; ++c) on_all[c] = on_all[c] && has(c);
    }
    for (std::size_t c = 0; c < corner_count; ++c) {
      if (on_all[c]) result[node].push_back(c);
    }
  }
  return result;
}

/// Sort key of a node in the elimination order; the members are compared in their order.
struct Turn {
  std::int32_t first_place = 0;
  std::int32_t fewer_corners = 0;
  std::int32_t representative = 0;
  std::int32_t node = 0;

  friend bool operator<(const Turn& a, const Turn& b) {
    return std::tie(a.first_place, a.fewer_corners, a.representative, a.node) <
           std::tie(b.first_place, b.fewer_corners, b.representative, b.node);
  }
};

}  // namespace

std::vector<std::int32_t> nested_dissection(std::span<const std::int32_t> offsets,
                                            std::span<const std::int32_t> columns) {
  std::vector<idx_t> own_offsets = {0};
  std::vector<idx_t> own_columns;
  own_offsets.reserve(offsets.size());
  own_columns.reserve(columns.size());
  for (std::size_t v = 0; v + 1 < offsets.size(); ++v) {
    for (std::int32_t k = offsets[v]; k < offsets[v + 1]; ++k) {
      const std::int32_t column = columns[static_cast<std::size_t>(k)];
      if (column != static_cast<std::int32_t>(v)) own_columns.push_back(column);
    }
    own_offsets.push_back(static_cast<idx_t>(own_columns.size()));
  }
  return order_without_loops(static_cast<idx_t>(own_offsets.size()) - 1, own_offsets.data(),
                             own_columns.data());
}

std::vector<std::int32_t> nested_dissection(const Mesh& mesh) {
  const std::vector<std::int32_t> stand_in = representatives(mesh);
  const CornerGraph graph(mesh, stand_in);
  const std::vector<std::int32_t> place = places_of_corners(graph);

  // Nodes are ordered by the first of their corners; those with the same one by the number of
  // corners, largest first.
  std::vector<Turn> turns(mesh.nodes.size());
  for (const ElementBlock& block : mesh.blocks) {
    const auto corners = defining_corners(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += corners.size()) {
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto node = static_cast<std::size_t>(block.nodes[first + i]);
        Turn& turn = turns[node];
        turn.first_place = std::numeric_limits<std::int32_t>::max();
        for (const std::size_t c : corners[i]) {
          const std::int32_t corner = graph.corner(block.nodes[first + c]);
          turn.first_place = std::min(turn.first_place, place[static_cast<std::size_t>(corner)]);
        }
        turn.fewer_corners = -static_cast<std::int32_t>(corners[i].size());
        turn.representative = stand_in[node];
        turn.node = block.nodes[first + i];
      }
    }
  }
  std::sort(turns.begin(), turns.end());
  std::vector<std::int32_t> order;
  order.reserve(turns.size());
  for (const Turn& turn : turns) order.push_back(turn.node);
  return order;
}

}  // namespace flexneck::mesher
