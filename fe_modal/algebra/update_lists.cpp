// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/update_lists.h"

namespace flexneck::fe_modal {
namespace {

/// Calls visit(target, update) for all updates, by ascending descendants.
template <typename Visitor>
void for_each_update(const SupernodeTree& tree, const Visitor& visit) {
  const auto supernodes = tree.supernodes();
  for (std::size_t d = 0; d < tree.eliminated_count(); ++d) {
    const auto rows = tree.rows_of(supernodes[d]);
    for (auto begin = static_cast<std::size_t>(supernodes[d].columns); begin < rows.size();) {
      const auto column = static_cast<std::size_t>(rows[begin]);
      const auto target = static_cast<std::size_t>(tree.supernode_of_column()[column]);
      std::size_t end = begin + 1;
      while (end < rows.size() && rows[end] < supernodes[target].end()) ++end;
      visit(target, Update{static_cast<int>(d), static_cast<int>(begin), static_cast<int>(end)});
      begin = end;
    }
  }
}

}  // namespace

UpdateLists::UpdateLists(const SupernodeTree& tree) : offsets_(tree.supernodes().size() + 1, 0) {
  for_each_update(tree, [&](std::size_t target, const Update&) { ++offsets_[target + 1]; });
  for (std::size_t k = 1; k < offsets_.size(); ++k) offsets_[k] += offsets_[k - 1];
  updates_.resize(offsets_.back());
  std::vector<std::size_t> next(offsets_.begin(), offsets_.end() - 1);
  for_each_update(
      tree, [&](std::size_t target, const Update& update) { updates_[next[target]++] = update; });
}

}  // namespace flexneck::fe_modal
