// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <span>
#include <string>

#include "fe_modal/iterative/schwarz.h"
#include "mesher/partition/element_partition.h"

namespace flexneck::fe_modal {
namespace {

/// Free nodes of a subdomain before it is widened. Smaller ones take less memory and more
/// iterations.
constexpr Eigen::Index kNodesOfSubdomain = 1300;

void sort_out_copies(std::vector<std::int32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

std::vector<std::int32_t> widened(const NodeGraph& graph, const std::vector<std::int32_t>& nodes) {
  std::vector<std::int32_t> result;
  for (const std::int32_t node : nodes) {
    const auto neighbours = graph.neighbours(node);
    result.insert(result.end(), neighbours.begin(), neighbours.end());
    if (result.size() > 16 * nodes.size() + 1024) sort_out_copies(result);
  }
  sort_out_copies(result);
  return result;
}

/// Rigid motions times the weight of each node.
Eigen::MatrixXd rigid_motions(const std::vector<std::int32_t>& nodes,
                              const Eigen::Matrix3Xd& positions_m,
                              const std::vector<double>& weights) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const std::int32_t node : nodes) centre += positions_m.col(node);
  centre /= static_cast<double>(nodes.size());
  double extent = 0;
  for (const std::int32_t node : nodes) {
    extent = std::max(extent, (positions_m.col(node) - centre).norm());
  }
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(nodes.size()), 6);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const Eigen::Vector3d arm = (positions_m.col(nodes[k]) - centre) / extent;
    Eigen::Matrix3d turn;  // column b: the motion by a rotation about axis b
    turn << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
    const auto row = static_cast<Eigen::Index>(3 * k);
    motions.block<3, 3>(row, 0).diagonal().setConstant(weights[static_cast<std::size_t>(nodes[k])]);
    motions.block<3, 3>(row, 3) = weights[static_cast<std::size_t>(nodes[k])] * turn;
  }
  return motions;
}

}  // namespace

Regions find_regions(const mesher::Mesh& mesh, const FreeNodes& free_nodes,
                     const NodeGraph& graph) {
  std::size_t elements = 0;
  for (const mesher::ElementBlock& block : mesh.blocks) elements += block.size();
  // Not one: that would be a factorisation of the whole.
  const auto count = static_cast<int>(
      std::min(std::max<Eigen::Index>(2, free_nodes.free_count() / kNodesOfSubdomain),
               static_cast<Eigen::Index>(elements)));
  const mesher::ElementPartition partition = mesher::partition_elements(mesh, count);
  std::vector<std::vector<std::int32_t>> subdomains(static_cast<std::size_t>(count));
  std::vector<std::string> names;
  std::vector<std::vector<std::int32_t>> parts;
  std::size_t element = 0;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    auto part =
        static_cast<std::size_t>(std::find(names.begin(), names.end(), block.part) - names.begin());
    if (part == names.size()) {
      names.push_back(block.part);
      parts.emplace_back();
    }
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += width, ++element) {
      for (const std::int32_t node : std::span(block.nodes).subspan(first, width)) {
        const std::int32_t index = free_nodes.index(node);
        if (index < 0) continue;
        subdomains[static_cast<std::size_t>(partition.processes[element])].push_back(index);
        parts[part].push_back(index);
      }
    }
  }
  Eigen::Matrix3Xd positions(3, free_nodes.free_count());
  for (std::int32_t node = 0; node < free_nodes.node_count(); ++node) {
    if (free_nodes.index(node) < 0) continue;
    positions.col(free_nodes.index(node)) =
        Eigen::Map<const Eigen::Vector3d>(mesh.nodes[static_cast<std::size_t>(node)].data());
  }
  Regions result;
  std::vector<double> weights(static_cast<std::size_t>(free_nodes.free_count()));
  for (std::vector<std::int32_t>& nodes : subdomains) {
    sort_out_copies(nodes);
    if (nodes.empty()) continue;
    nodes = widened(graph, nodes);
    for (const std::int32_t node : nodes) weights[static_cast<std::size_t>(node)] += 1;
  }
  for (double& weight : weights) weight = 1 / weight;
  for (const std::vector<std::int32_t>& nodes : subdomains) {
    if (!nodes.empty()) {
      result.subdomains.push_back({nodes, rigid_motions(nodes, positions, weights)});
    }
  }
  std::fill(weights.begin(), weights.end(), 1.0);
  for (std::vector<std::int32_t>& nodes : parts) {
    sort_out_copies(nodes);
    if (!nodes.empty()) result.parts.push_back({nodes, rigid_motions(nodes, positions, weights)});
  }
  return result;
}

}  // namespace flexneck::fe_modal
