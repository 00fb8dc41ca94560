// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/system/model.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <span>
#include <utility>

#include "fe_modal/dofs/point_element.h"
#include "fe_modal/system/elimination_order.h"
#include "fe_modal/system/modal_options_check.h"
#include "geometry/foundation/error.h"
#include "mesher/partition/element_partition.h"

namespace flexneck::fe_modal {
namespace {

/// Calls visit(number of the element, its nodes) for each element, the mesh's blocks in their
/// order; then for springs and point masses, with their sites.
void for_each_element(
    const mesher::Mesh& mesh,
    const std::function<void(std::size_t, std::span<const std::int32_t>)>& visit) {
  std::size_t element = 0;
  for (const mesher::ElementBlock& block : mesh.blocks) {
    const std::size_t width = mesher::nodes_per_element(block.kind);
    for (std::size_t first = 0; first < block.nodes.size(); first += width)
      visit(element++, std::span(block.nodes).subspan(first, width));
  }
  for (const PointElement& point : point_elements_of(mesh.connections, mesh.nodes.size()))
    visit(element++, point.sites);
}

void require_work_for_all(const std::vector<std::int32_t>& rank_of_element, int count) {
  for (int rank = 0; rank < count; ++rank) {
    if (std::find(rank_of_element.begin(), rank_of_element.end(), rank) != rank_of_element.end())
      continue;
    throw InputError("rank " + std::to_string(rank) + " of " + std::to_string(count) +
                     " would have none of the mesh's " + std::to_string(rank_of_element.size()) +
                     " elements; start fewer ranks");
  }
}

}  // namespace

Model::Model(const mesher::Mesh& mesh, ModalOptions options)
    : mesh_(mesh),
      options_(std::move(options)),
      connections_(connections_of(mesh, options_)),
      dof_map_(dof_map_of(mesh, options_)),
      rigid_(mesh, connections_, dof_map_),
      fields_(numbered()) {}

FieldMap Model::numbered() {
  if (ranks().are_many()) return {dof_map_, shared_out()};
  dof_map_.renumber(elimination_order_of(mesh_, dof_map_, options_.node_order));
  return {dof_map_, DofLayout(dof_map_.free_count(), ranks())};
}

/// Distributes the blocks: a block belongs to the lowest rank that has one of its elements, and to
/// the first rank if none has.
DofLayout Model::shared_out() {
  const int count = ranks().count();
  rank_of_element_ = options_.element_ranks.empty()
                         ? mesher::partition_elements(mesh_, count).processes
                         : options_.element_ranks;
  require_work_for_all(rank_of_element_, count);
  const auto blocks = static_cast<std::size_t>(dof_map_.free_count());
  std::vector<std::int32_t> owners(blocks, count);
  for_each_element(mesh_, [&](std::size_t element, auto sites) {
    // Springs and masses go to the first rank.
    if (element >= rank_of_element_.size()) rank_of_element_.push_back(0);
    for (const std::int32_t site : sites) {
      dof_map_.for_each_number(site, [&](std::int32_t block) {
        std::int32_t& owner = owners[static_cast<std::size_t>(block)];
        owner = std::min(owner, rank_of_element_[element]);
      });
    }
  });
  std::replace(owners.begin(), owners.end(), count, 0);
  std::vector<std::int32_t> order(blocks);
  std::iota(order.begin(), order.end(), 0);
  const auto owner = [&](std::int32_t block) { return owners[static_cast<std::size_t>(block)]; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::int32_t one, std::int32_t other) { return owner(one) < owner(other); });
  dof_map_.renumber(order);
  std::vector<int> counts(static_cast<std::size_t>(count), 0);
  for (const std::int32_t rank : owners) ++counts[static_cast<std::size_t>(rank)];
  return {ranks(), counts};
}

}  // namespace flexneck::fe_modal
