// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/separator.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include <Eigen/Core>

#include "fe_modal/algebra/cholesky_factor.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Columns of a panel at most: a rank that owns one factorises it while the others wait.
constexpr int kMaxPanelColumns = 192;

/// Blocks that the same ranks have.
struct Group {
  std::vector<std::int32_t> ranks;   ///< ascending
  std::vector<std::int32_t> blocks;  ///< numbers in the whole, ascending
  std::set<std::size_t> neighbours;  ///< groups that are joined to it and not yet eliminated
  int first_row = 0;

  int row_count() const { return 3 * static_cast<int>(blocks.size()); }
};

/// Collective: groups of the blocks that several ranks have, the same on all ranks.
std::vector<Group> groups_between(const Ranks& ranks, std::size_t block_count,
                                  std::span<const std::int32_t> blocks) {
  Eigen::VectorXd holders = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(block_count));
  for (const std::int32_t block : blocks) holders[block] = 1;
  ranks.sum(holders);
  std::vector<std::int32_t> shared;
  std::vector<Eigen::Index> place_of(block_count, -1);
  for (std::size_t block = 0; block < block_count; ++block) {
    const double count = holders[static_cast<Eigen::Index>(block)];
    if (count == 0) throw ComputationError(kNotDefinite);
    if (count < 2) continue;
    place_of[block] = static_cast<Eigen::Index>(shared.size());
    shared.push_back(static_cast<std::int32_t>(block));
  }
  Eigen::MatrixXd has =
      Eigen::MatrixXd::Zero(ranks.count(), static_cast<Eigen::Index>(shared.size()));
  for (const std::int32_t block : blocks) {
    const Eigen::Index place = place_of[static_cast<std::size_t>(block)];
    if (place >= 0) has(ranks.own(), place) = 1;
  }
  ranks.sum(has);
  std::map<std::vector<std::int32_t>, std::vector<std::int32_t>> blocks_of;
  for (std::size_t k = 0; k < shared.size(); ++k) {
    std::vector<std::int32_t> holding;
    for (std::int32_t rank = 0; rank < ranks.count(); ++rank) {
      if (has(rank, static_cast<Eigen::Index>(k)) > 0) holding.push_back(rank);
    }
    blocks_of[holding].push_back(shared[k]);
  }
  std::vector<Group> groups;
  groups.reserve(blocks_of.size());
  for (auto& [holding, members] : blocks_of) groups.push_back({holding, members, {}, 0});
  return groups;
}

/// Groups that a rank has both, whose parts join them.
void find_neighbours(std::vector<Group>& groups, std::int32_t rank_count) {
  for (std::int32_t rank = 0; rank < rank_count; ++rank) {
    std::vector<std::size_t> joined;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (std::binary_search(groups[g].ranks.begin(), groups[g].ranks.end(), rank))
        joined.push_back(g);
    }
    for (const std::size_t g : joined) groups[g].neighbours.insert(joined.begin(), joined.end());
  }
  for (std::size_t g = 0; g < groups.size(); ++g) groups[g].neighbours.erase(g);
}

int degree(const std::vector<Group>& groups, std::size_t g) {
  int rows = groups[g].row_count();
  for (const std::size_t other : groups[g].neighbours) rows += groups[other].row_count();
  return rows;
}

/// The order of least degrees. Each group keeps the neighbours that it had when its turn came.
std::vector<std::size_t> order_of(std::vector<Group>& groups) {
  std::set<std::size_t> left;
  for (std::size_t g = 0; g < groups.size(); ++g) left.insert(g);
  std::vector<std::size_t> order;
  while (!left.empty()) {
    std::size_t next = *left.begin();
    int least = std::numeric_limits<int>::max();
    for (const std::size_t g : left) {
      const int rows = degree(groups, g);
      if (rows < least) {
        least = rows;
        next = g;
      }
    }
    left.erase(next);
    order.push_back(next);
    const std::set<std::size_t>& front = groups[next].neighbours;
    for (const std::size_t g : front) {
      groups[g].neighbours.insert(front.begin(), front.end());
      groups[g].neighbours.erase(g);
      groups[g].neighbours.erase(next);
    }
  }
  return order;
}

/// Of a group and those that it is joined to, ascending.
std::vector<int> rows_of(const Group& group, const std::vector<Group>& groups) {
  std::vector<int> rows;
  const auto append = [&rows](const Group& more) {
    for (int row = 0; row < more.row_count(); ++row) rows.push_back(more.first_row + row);
  };
  append(group);
  for (const std::size_t other : group.neighbours) append(groups[other]);
  std::sort(rows.begin(), rows.end());
  return rows;
}

}  // namespace

Separator::Separator(const Ranks& ranks, std::size_t block_count,
                     std::span<const std::int32_t> blocks) {
  std::vector<Group> groups = groups_between(ranks, block_count, blocks);
  find_neighbours(groups, ranks.count());
  const std::vector<std::size_t> order = order_of(groups);
  for (const std::size_t g : order) {
    groups[g].first_row = row_count_;
    row_count_ += groups[g].row_count();
  }
  std::vector<std::int32_t> place_of(block_count, -1);
  for (std::size_t place = 0; place < blocks.size(); ++place)
    place_of[static_cast<std::size_t>(blocks[place])] = static_cast<std::int32_t>(place);
  std::vector<bool> is_shared(blocks.size(), false);
  for (const std::size_t g : order) {
    const Group& group = groups[g];
    const bool is_own = std::binary_search(group.ranks.begin(), group.ranks.end(), ranks.own());
    add_panels(rows_of(group, groups), group.row_count(), is_own, ranks.count());
    for (const std::int32_t block : is_own ? group.blocks : std::vector<std::int32_t>()) {
      const std::int32_t place = place_of[static_cast<std::size_t>(block)];
      is_shared[static_cast<std::size_t>(place)] = true;
      shared_.push_back(place);
    }
  }
  for (std::size_t place = 0; place < blocks.size(); ++place) {
    if (!is_shared[place]) inside_.push_back(static_cast<std::int32_t>(place));
  }
}

void Separator::add_panels(std::span<const int> rows, int columns, bool is_own,
                           std::int32_t rank_count) {
  if (is_own) rows_.insert(rows_.end(), rows.begin(), rows.begin() + columns);
  for (int begin = 0; begin < columns; begin += kMaxPanelColumns) {
    if (is_own) own_panels_.push_back(panels_.size());
    const auto owner = static_cast<std::int32_t>(panels_.size()) % rank_count;
    panels_.push_back({rows[static_cast<std::size_t>(begin)],
                       std::min(kMaxPanelColumns, columns - begin),
                       {rows.begin() + begin, rows.end()},
                       owner});
  }
}

}  // namespace flexneck::fe_modal
