// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesher/partition/element_partition.h"

#include <algorithm>
#include <string>

#include "geometry/foundation/error.h"
#include "mesher/mesh/boundary.h"
#include "mesher/partition/corner_lists.h"
#include "mesher/partition/metis.h"

namespace flexneck::mesher {
namespace {

/// Number of common corners from which two elements have a common facet.
constexpr idx_t kCornersOfAFacet = 3;
/// Number of cuts of which each bisection takes the best, and the deviation of the halves from the
/// mean in thousandths. METIS's k-way partition, with one of up to 30 thousandths, leaves a sixth
/// more degrees of freedom between two, four and eight parts of the neck with 191 000.
constexpr idx_t kCuts = 10;
constexpr idx_t kImbalance = 50;

/// Moves elements to empty parts: METIS may leave a part of a small mesh without elements.
void fill_empty(std::vector<std::int32_t>& processes, int count) {
  std::vector<std::int32_t> sizes(static_cast<std::size_t>(count));
  for (const std::int32_t process : processes) ++sizes[static_cast<std::size_t>(process)];
  for (auto empty = sizes.begin(); (empty = std::find(empty, sizes.end(), 0)) != sizes.end();) {
    const auto largest = std::max_element(sizes.begin(), sizes.end());
    const auto from = static_cast<std::int32_t>(largest - sizes.begin());
    *std::find(processes.begin(), processes.end(), from) =
        static_cast<std::int32_t>(empty - sizes.begin());
    --*largest;
    ++*empty;
  }
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
  options[METIS_OPTION_PTYPE] = METIS_PTYPE_RB;
  options[METIS_OPTION_NCUTS] = kCuts;
  options[METIS_OPTION_UFACTOR] = kImbalance;
  auto node_count = static_cast<idx_t>(mesh.nodes.size());
  idx_t common = kCornersOfAFacet;
  idx_t parts = count;
  idx_t cut = 0;
  std::vector<idx_t> process_of_node(mesh.nodes.size());
  require_metis(
      METIS_PartMeshDual(&element_count, &node_count, lists.offsets.data(), lists.corners.data(),
                         nullptr, nullptr, &common, &parts, nullptr, options.data(), &cut,
                         partition.processes.data(), process_of_node.data()),
      "partitioning the elements");
  fill_empty(partition.processes, count);
  return partition;
}

PartitionQuality quality_of(const Mesh& mesh, const ElementPartition& partition) {
  PartitionQuality quality;
  const std::vector<FacetPlace> sides = facets_by_key(mesh);
  const auto process_of = [&](const FacetPlace& side) { return partition.processes[side.number]; };
  for (std::size_t s = 1; s < sides.size(); ++s) {
    if (sides[s].key == sides[s - 1].key && process_of(sides[s]) != process_of(sides[s - 1])) {
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
