// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fe_modal/algebra/supernode_tree.h"

namespace flexneck::fe_modal {

/// Rows [begin, end) of a supernode that are columns of another, which must be updated by it.
struct Update {
  int descendant;
  int begin;
  int end;
};

/// The updates of each supernode and of each block of kept rows.
class UpdateLists {
 public:
  explicit UpdateLists(const SupernodeTree& tree);

  /// By ascending descendants.
  std::span<const Update> of(std::size_t supernode) const {
    return std::span(updates_).subspan(offsets_[supernode],
                                       offsets_[supernode + 1] - offsets_[supernode]);
  }

 private:
  std::vector<std::size_t> offsets_;
  std::vector<Update> updates_;
};

}  // namespace flexneck::fe_modal
