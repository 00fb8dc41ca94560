// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/rank_part.h"

#include <algorithm>
#include <numeric>

namespace flexneck::fe_modal {

RankPart::RankPart(const mesher::Mesh& mesh, const DofMap& dof_map)
    : whole_(mesh),
      whole_dof_map_(dof_map),
      blocks_(static_cast<std::size_t>(dof_map.free_count())) {
  std::iota(blocks_.begin(), blocks_.end(), 0);
}

RankPart::RankPart(const mesher::Mesh& mesh, const DofMap& dof_map,
                   const std::vector<std::int32_t>& numbers, std::int32_t number)
    : whole_(mesh), whole_dof_map_(dof_map), piece_(mesher::submesh(mesh, numbers, number)) {
  dof_map_ = dof_map.part(piece_->nodes, blocks_);
}

Eigen::MatrixXd RankPart::rows_of_nodes(const Eigen::MatrixXd& all) const {
  if (!piece_) return all;
  return all(piece_->nodes, Eigen::all);
}

Eigen::Matrix3Xd RankPart::columns_of_nodes(const Eigen::Matrix3Xd& all) const {
  if (!piece_ || all.cols() == 0) return all;
  return all(Eigen::all, piece_->nodes);
}

void for_each_element(
    const mesher::Mesh& mesh,
    const std::function<void(std::size_t, std::span<const std::int32_t>)>& visit) {
  std::size_t element = 0;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += width) {
      visit(element++, std::span(block.nodes).subspan(first, width));
    }
  }
}

DofLayout layout_of(const Ranks& ranks, const mesher::Mesh& mesh, const DofMap& dof_map,
                    const std::vector<std::int32_t>& rank_of_element) {
  if (!ranks.are_many()) return DofLayout(dof_map.free_count());
  std::vector<std::int32_t> owners(static_cast<std::size_t>(dof_map.free_count()), ranks.count());
  for_each_element(mesh, [&](std::size_t element, std::span<const std::int32_t> nodes) {
    for (const std::int32_t node : nodes) {
      dof_map.for_each_number(node, [&](std::int32_t block) {
        std::int32_t& owner = owners[static_cast<std::size_t>(block)];
        owner = std::min(owner, rank_of_element[element]);
      });
    }
  });
  // What no element has is of the first rank.
  std::replace(owners.begin(), owners.end(), ranks.count(), 0);
  return {ranks, std::move(owners)};
}

}  // namespace flexneck::fe_modal
