// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/distributed/share.h"

#include <algorithm>
#include <span>

namespace flexneck::fe_modal {
namespace {

/// The elements that belong to one process, nodes by their numbers in the whole mesh.
std::vector<mesher::ElementBlock> blocks_of(const mesher::Mesh& mesh,
                                            const mesher::ElementPartition& partition,
                                            std::int32_t process) {
  std::vector<mesher::ElementBlock> blocks;
  std::size_t element = 0;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    mesher::ElementBlock own{block.part, block.kind, block.material, {}};
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += width, ++element) {
      if (partition.processes[element] != process) continue;
      const auto nodes = std::span(block.nodes).subspan(first, width);
      own.nodes.insert(own.nodes.end(), nodes.begin(), nodes.end());
    }
    if (!own.nodes.empty()) blocks.push_back(std::move(own));
  }
  return blocks;
}

/// Position in a list that ascends and has the value.
std::int32_t place_in(const std::vector<std::int32_t>& list, std::int32_t value) {
  return static_cast<std::int32_t>(std::lower_bound(list.begin(), list.end(), value) -
                                   list.begin());
}

void sort_out_copies(std::vector<std::int32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

Share share_of(const mesher::Mesh& mesh, const FreeNodes& free_nodes,
               const mesher::ElementPartition& partition, std::int32_t process) {
  Share share;
  share.mesh.materials = mesh.materials;
  share.mesh.blocks = blocks_of(mesh, partition, process);
  for (const mesher::ElementBlock& block : share.mesh.blocks) {
    share.nodes.insert(share.nodes.end(), block.nodes.begin(), block.nodes.end());
  }
  sort_out_copies(share.nodes);
  for (mesher::ElementBlock& block : share.mesh.blocks) {
    for (std::int32_t& node : block.nodes) node = place_in(share.nodes, node);
  }
  for (const std::int32_t node : share.nodes) {
    share.mesh.nodes.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
    if (free_nodes.index(node) >= 0) share.free_global.push_back(free_nodes.index(node));
  }
  sort_out_copies(share.free_global);
  for (const std::int32_t node : share.nodes) {
    const std::int32_t index = free_nodes.index(node);
    share.free_index.push_back(index < 0 ? -1 : place_in(share.free_global, index));
  }
  return share;
}

}  // namespace

std::vector<Share> share_out(const mesher::Mesh& mesh, const FreeNodes& free_nodes,
                             const mesher::ElementPartition& partition) {
  std::vector<Share> shares;
  for (std::int32_t process = 0; process < partition.count; ++process) {
    shares.push_back(share_of(mesh, free_nodes, partition, process));
  }
  return shares;
}

}  // namespace flexneck::fe_modal
