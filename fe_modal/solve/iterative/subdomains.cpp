// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/subdomains.h"

#include <algorithm>
#include <span>
#include <string>

#include "mesher/mesh/positions.h"
#include "mesher/partition/element_partition.h"

namespace flexneck::fe_modal {
namespace {

/// Nodes of a subdomain before it is extended; up to twice as many where a part is not cut. Smaller
/// ones hardly save memory, for they overlap more, and take more iterations: every cut through a
/// thin layer of rubber or a plate costs some.
constexpr std::size_t kNodesOfSubdomain = 10000;

void sort_out_copies(std::vector<std::int32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Of nodes that are known by their elements, with copies.
void sort_out_copies_and_fixed(std::vector<std::int32_t>& list) {
  sort_out_copies(list);
  if (!list.empty() && list.front() < 0) list.erase(list.begin());
}

/// Elements of one part alone.
mesher::Mesh part_of(const mesher::Mesh& mesh, const std::string& name) {
  mesher::Mesh result;
  result.nodes = mesh.nodes;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    if (block.part == name) result.blocks.push_back(block);
  }
  return result;
}

/// Free nodes of the elements of one part by subdomains.
NodeLists cut(const mesher::Mesh& part, const DofMap& dof_map, std::size_t least_count) {
  std::vector<std::int32_t> all;
  std::size_t elements = 0;
  for (const mesher::ElementBlock& block : part.blocks) {
    for (const std::int32_t node : block.nodes) all.push_back(dof_map.index(node));
    elements += block.size();
  }
  sort_out_copies_and_fixed(all);
  const std::size_t count =
      std::min(elements, std::max(least_count, all.size() / kNodesOfSubdomain));
  const mesher::ElementPartition partition =
      mesher::partition_elements(part, static_cast<int>(count));
  NodeLists subdomains(count);
  std::size_t element = 0;
  for (const mesher::ElementBlock& block : part.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += width, ++element) {
      auto& own = subdomains[static_cast<std::size_t>(partition.processes[element])];
      for (const std::int32_t node : std::span(block.nodes).subspan(first, width)) {
        own.push_back(dof_map.index(node));
      }
    }
  }
  for (std::vector<std::int32_t>& nodes : subdomains) sort_out_copies_and_fixed(nodes);
  return subdomains;
}

}  // namespace

NodeLists find_subdomains(const mesher::Mesh& mesh, const DofMap& dof_map) {
  const std::vector<std::string> parts = mesher::parts_of(mesh);
  NodeLists subdomains;
  for (const std::string& part : parts) {
    // One alone would be the whole.
    const std::size_t least_count = parts.size() == 1 ? 2 : 1;
    for (std::vector<std::int32_t>& nodes : cut(part_of(mesh, part), dof_map, least_count)) {
      if (!nodes.empty()) subdomains.push_back(std::move(nodes));
    }
  }
  return subdomains;
}

std::vector<std::int32_t> extended(const NodeGraph& graph, const std::vector<std::int32_t>& nodes) {
  std::vector<std::int32_t> layer;
  for (const std::int32_t node : nodes) {
    const auto neighbours = graph.neighbours(node);
    layer.insert(layer.end(), neighbours.begin(), neighbours.end());
  }
  sort_out_copies(layer);
  std::vector<std::int32_t> result;
  std::copy_if(layer.begin(), layer.end(), std::back_inserter(result), [&](std::int32_t node) {
    const auto neighbours = graph.neighbours(node);
    return std::includes(layer.begin(), layer.end(), neighbours.begin(), neighbours.end());
  });
  return result;
}

Eigen::Matrix3Xd free_positions(const mesher::Mesh& mesh, const DofMap& dof_map) {
  const auto all = mesher::positions_of(mesh);
  Eigen::Matrix3Xd positions(3, dof_map.free_count());
  for (std::int32_t node = 0; node < dof_map.node_count(); ++node) {
    if (dof_map.index(node) < 0) continue;
    positions.col(dof_map.index(node)) = all.col(node);
  }
  return positions;
}

}  // namespace flexneck::fe_modal
