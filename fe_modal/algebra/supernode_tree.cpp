// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/supernode_tree.h"

#include <algorithm>
#include <cholmod.h>
#include <numeric>

namespace flexneck::fe_modal {
namespace {

/// A subtree with a larger share of the factor's entries is divided: eight subtrees at least for
/// threads. With 1/32 two threads took 6 % longer to solve at 191 000 degrees of freedom, for the
/// top of the tree, which one thread solves, is larger.
constexpr double kMaxShareOfSubtree = 1.0 / 8;
/// Entries of a factor that is too small to be shared out: its solve takes some 0.1 ms, as the
/// start of a few threads.
constexpr double kFewEntries = 1e5;
/// Wider supernodes are divided, for threads to share.
constexpr int kMaxColumns = 512;

}  // namespace

SupernodeTree::SupernodeTree(const cholmod_factor_struct& factor, int block_size,
                             std::span<const int> kept) {
  const int size = static_cast<int>(factor.n) * block_size;
  int first_kept = size - std::accumulate(kept.begin(), kept.end(), 0);
  supernode_of_column_.resize(as_index(size));
  take(factor, block_size, first_kept);
  eliminated_count_ = supernodes_.size();
  std::vector<int> rows(as_index(size - first_kept));
  std::iota(rows.begin(), rows.end(), first_kept);
  for (const int columns : kept) {
    add({first_kept, columns, size - first_kept},
        std::span(rows).last(as_index(size - first_kept)));
    first_kept += columns;
  }
  find_subtrees();
}

/// Supernodes of the columns before the end.
void SupernodeTree::take(const cholmod_factor_struct& factor, int block_size, int end_row) {
  const auto list = [](const void* data, std::size_t count) {
    return std::span(static_cast<const int*>(data), count);
  };
  const auto entries_of = [block_size](std::span<const int> numbers) {
    std::vector<int> entries;
    entries.reserve(numbers.size() * as_index(block_size));
    for (const int number : numbers) {
      for (int a = 0; a < block_size; ++a) entries.push_back(number * block_size + a);
    }
    return entries;
  };
  const auto rows = list(factor.s, factor.ssize);
  const auto columns = list(factor.super, factor.nsuper + 1);
  const auto row_lists = list(factor.pi, factor.nsuper + 1);
  order_ = entries_of(list(factor.Perm, factor.n));
  for (std::size_t k = 0; k < factor.nsuper && columns[k] * block_size < end_row; ++k) {
    const int first = columns[k] * block_size;
    const int width = std::min(columns[k + 1] * block_size, end_row) - first;
    const std::vector<int> own =
        entries_of(rows.subspan(as_index(row_lists[k]), as_index(row_lists[k + 1] - row_lists[k])));
    const int pieces = (width + kMaxColumns - 1) / kMaxColumns;
    for (int piece = 0; piece < pieces; ++piece) {
      // Blocks of nodes stay together.
      const auto begin_of = [&](int p) { return p == pieces ? width : width / 3 * p / pieces * 3; };
      const int begin = begin_of(piece);
      const Supernode node{first + begin, begin_of(piece + 1) - begin,
                           static_cast<int>(own.size()) - begin, 0, value_count_};
      add(node, std::span(own).subspan(as_index(begin)));
      value_count_ += as_index(node.rows) * as_index(node.columns);
    }
  }
}

void SupernodeTree::add(Supernode node, std::span<const int> rows) {
  node.row_list = rows_.size();
  rows_.insert(rows_.end(), rows.begin(), rows.end());
  max_rows_ = std::max(max_rows_, node.rows);
  std::fill_n(supernode_of_column_.begin() + node.first, node.columns,
              static_cast<int>(supernodes_.size()));
  supernodes_.push_back(node);
}

void SupernodeTree::find_subtrees() {
  const std::size_t count = eliminated_count_;
  // Of each subtree: its first supernode, how many it has, and the entries of the factor in it.
  std::vector<std::size_t> first(count);
  std::vector<std::size_t> size(count, 1);
  std::vector<double> entries(count);
  std::vector<std::vector<std::size_t>> children(count);
  std::vector<std::size_t> candidates;
  std::iota(first.begin(), first.end(), std::size_t{0});
  for (std::size_t k = 0; k < count; ++k) {
    const Supernode& node = supernodes_[k];
    entries[k] += static_cast<double>(node.rows) * node.columns;
    const std::size_t parent =
        node.rows == node.columns
            ? count
            : as_index(supernode_of_column_[as_index(rows_of(node)[as_index(node.columns)])]);
    if (parent >= count) {
      candidates.push_back(k);
      continue;
    }
    children[parent].push_back(k);
    first[parent] = std::min(first[parent], first[k]);
    size[parent] += size[k];
    entries[parent] += entries[k];
  }
  double all = 0;
  for (const std::size_t root : candidates) all += entries[root];
  while (!candidates.empty()) {
    const std::size_t k = candidates.back();
    candidates.pop_back();
    const bool are_neighbours = first[k] + size[k] == k + 1;
    if (all > kFewEntries && are_neighbours && entries[k] <= kMaxShareOfSubtree * all) {
      const Supernode& root = supernodes_[k];
      subtrees_.push_back(
          {first[k], k + 1, root.end(), rows_of(root).subspan(as_index(root.columns))});
    } else {
      top_.push_back(k);
      candidates.insert(candidates.end(), children[k].begin(), children[k].end());
    }
  }
  std::sort(top_.begin(), top_.end());
  std::sort(subtrees_.begin(), subtrees_.end(),
            [](const Subtree& one, const Subtree& other) { return one.begin < other.begin; });
}

}  // namespace flexneck::fe_modal
