// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fe_modal/algebra/ranks.h"

namespace flexneck::fe_modal {

/// Columns of a separator's factor that have the same rows below them.
struct Panel {
  int first = 0;  ///< row of the separator
  int columns = 0;
  std::vector<int> rows;   ///< ascending; the first are the columns themselves
  std::int32_t owner = 0;  ///< the rank that keeps it
};

/// Blocks of degrees of freedom that parts of several ranks have, in an order of elimination: what
/// is left when each rank has eliminated all other blocks of its part. Those that the same ranks
/// have follow one another; which of these groups is next is decided by the least degree.
class Separator {
 public:
  /// Collective.
  /// @param block_count of the whole
  /// @param blocks of this rank's part, their numbers in the whole
  /// @throws ComputationError if a block is in no part.
  Separator(const Ranks& ranks, std::size_t block_count, std::span<const std::int32_t> blocks);

  int row_count() const { return row_count_; }  ///< degrees of freedom
  const std::vector<Panel>& panels() const { return panels_; }

  /// Places in the part of the blocks that no other rank has, ascending.
  const std::vector<std::int32_t>& inside() const { return inside_; }
  /// Places in the part of the separator's blocks that it has, in their order there.
  const std::vector<std::int32_t>& shared() const { return shared_; }
  /// The separator's rows of those.
  const std::vector<int>& rows() const { return rows_; }
  /// Panels whose columns the part has.
  const std::vector<std::size_t>& own_panels() const { return own_panels_; }

 private:
  /// Of a group of so many columns.
  /// @param rows of its factor, the first those of the columns
  /// @param is_own whether the part has them
  void add_panels(std::span<const int> rows, int columns, bool is_own, std::int32_t rank_count);

  std::vector<std::int32_t> inside_;
  std::vector<std::int32_t> shared_;
  std::vector<int> rows_;
  std::vector<std::size_t> own_panels_;
  std::vector<Panel> panels_;
  int row_count_ = 0;
};

}  // namespace flexneck::fe_modal
