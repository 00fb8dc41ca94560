// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/partition/element_partition.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <tuple>

#include "geometry/foundation/error.h"
#include "mesher/partition/metis.h"

namespace flexneck::mesher {
namespace {

/// Elements with three common corners have a common side.
constexpr idx_t kCornersOfASide = 3;

/// Elements by their corners, in compressed rows.
struct CornerLists {
  std::vector<idx_t> offsets = {0};
  std::vector<idx_t> corners;
};

CornerLists corner_lists(const Mesh& mesh) {
  CornerLists lists;
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t width = nodes_per_element(block.kind);
    const auto corners = static_cast<std::ptrdiff_t>(corners_per_element(block.kind));
    for (std::size_t e = 0; e < block.size(); ++e) {
      const auto first = block.nodes.begin() + static_cast<std::ptrdiff_t>(e * width);
      lists.corners.insert(lists.corners.end(), first, first + corners);
      lists.offsets.push_back(static_cast<idx_t>(lists.corners.size()));
    }
  }
  return lists;
}

/// A side by its three lowest corner nodes, which no other side of a conforming mesh has, and the
/// process of an element behind it.
struct OwnedSide {
  std::array<std::int32_t, 3> corners;
  std::int32_t process;

  friend bool operator<(const OwnedSide& a, const OwnedSide& b) {
    return std::tie(a.corners, a.process) < std::tie(b.corners, b.process);
  }
};

std::vector<OwnedSide> owned_sides(const Mesh& mesh, const ElementPartition& partition) {
  std::vector<OwnedSide> sides;
  std::size_t element = 0;
  for (const ElementBlock& block : mesh.blocks) {
    const std::size_t width = nodes_per_element(block.kind);
    for (std::size_t e = 0; e < block.size(); ++e, ++element) {
      for (const Side& side : sides_of(block.kind)) {
        const std::size_t corners = corners_per_element(side.kind);
        std::array<std::int32_t, 4> nodes{};
        nodes.fill(std::numeric_limits<std::int32_t>::max());
        for (std::size_t c = 0; c < corners; ++c) {
          nodes[c] = block.nodes[e * width + side.nodes[c]];
        }
        std::sort(nodes.begin(), nodes.end());
        sides.push_back({{nodes[0], nodes[1], nodes[2]}, partition.processes[element]});
      }
    }
  }
  return sides;
}

}  // namespace

ElementPartition partition_elements(const Mesh& mesh, int count) {
  CornerLists lists = corner_lists(mesh);
  auto element_count = static_cast<idx_t>(lists.offsets.size()) - 1;
  if (count < 1 || count > element_count) {
    throw InputError("partition for " + std::to_string(count) + " processes: expected 1 to " +
                     std::to_string(element_count) + ", the number of elements");
  }
  ElementPartition partition{count,
                             std::vector<std::int32_t>(static_cast<std::size_t>(element_count))};
  if (count == 1) return partition;

  MetisOptions options = metis_options();
  auto node_count = static_cast<idx_t>(mesh.nodes.size());
  idx_t common = kCornersOfASide;
  idx_t parts = count;
  idx_t cut = 0;
  std::vector<idx_t> process_of_node(mesh.nodes.size());
  require_metis(
      METIS_PartMeshDual(&element_count, &node_count, lists.offsets.data(), lists.corners.data(),
                         nullptr, nullptr, &common, &parts, nullptr, options.data(), &cut,
                         partition.processes.data(), process_of_node.data()),
      "sharing out the elements");
  return partition;
}

PartitionQuality quality_of(const Mesh& mesh, const ElementPartition& partition) {
  PartitionQuality quality;
  std::vector<OwnedSide> sides = owned_sides(mesh, partition);
  std::sort(sides.begin(), sides.end());
  for (std::size_t s = 1; s < sides.size(); ++s) {
    if (sides[s].corners == sides[s - 1].corners && sides[s].process != sides[s - 1].process) {
      ++quality.edge_cut;
    }
  }
  std::vector<std::size_t> sizes(static_cast<std::size_t>(partition.count));
  for (const std::int32_t process : partition.processes) {
    ++sizes[static_cast<std::size_t>(process)];
  }
  quality.balance = static_cast<double>(*std::max_element(sizes.begin(), sizes.end())) *
                    partition.count / static_cast<double>(partition.processes.size());
  return quality;
}

}  // namespace flexneck::mesher
