// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <vector>

struct cholmod_factor_struct;  // of CHOLMOD, whose header stays in the .cpp files

namespace flexneck::fe_modal {

/// CHOLMOD counts rows by int.
constexpr std::size_t as_index(int row) { return static_cast<std::size_t>(row); }

/// Columns of a Cholesky factor that have the same rows below them; a dense block of `rows` by
/// `columns` numbers, column by column, whose first rows are the columns themselves.
struct Supernode {
  int first = 0;  ///< column
  int columns = 0;
  int rows = 0;
  std::size_t row_list = 0;  ///< where the rows begin in the list of all
  std::size_t block = 0;     ///< where the block begins in the values

  int end() const { return first + columns; }
};

/// A supernode with all below it in the elimination tree, which have neighbouring numbers.
struct Subtree {
  std::size_t begin = 0;  ///< supernodes
  std::size_t end = 0;
  int end_row = 0;
  std::span<const int> ancestors;  ///< rows above it in the tree that it updates, ascending
};

/// The places of the entries of a supernodal Cholesky factor, P A P^T = L L^T, and its elimination
/// tree, divided into subtrees for threads and a top. The last rows may be kept: then L has the
/// other columns only, and blocks of columns of the kept rows have the places of their Schur
/// complement.
class SupernodeTree {
 public:
  SupernodeTree() = default;
  /// @param factor with the places of its entries, or of blocks of so many rows and columns; may go
  /// afterwards
  /// @param kept columns of each group of the rows that are kept, in their order, whole blocks
  SupernodeTree(const cholmod_factor_struct& factor, int block_size,
                std::span<const int> kept = {});
  SupernodeTree(SupernodeTree&&) = default;
  SupernodeTree& operator=(SupernodeTree&&) = default;

  /// Entry k is the row of A that comes k-th.
  std::span<const int> order() const { return order_; }
  /// Those that are eliminated, then the blocks of kept rows, whose values are not counted.
  std::span<const Supernode> supernodes() const { return supernodes_; }
  std::size_t eliminated_count() const { return eliminated_count_; }
  std::span<const Supernode> eliminated() const { return supernodes().first(eliminated_count_); }
  std::span<const Supernode> kept() const { return supernodes().subspan(eliminated_count_); }
  /// Ascending; the first are the supernode's columns.
  std::span<const int> rows_of(const Supernode& node) const {
    return std::span(rows_).subspan(node.row_list, static_cast<std::size_t>(node.rows));
  }
  /// Of all supernodes.
  std::span<const int> row_lists() const { return rows_; }
  /// By column of the factor.
  std::span<const int> supernode_of_column() const { return supernode_of_column_; }
  /// Numbers in all blocks of L.
  std::size_t value_count() const { return value_count_; }
  int max_rows() const { return max_rows_; }

  /// Independent of one another, ascending.
  std::span<const Subtree> subtrees() const { return subtrees_; }
  /// All other supernodes, ascending.
  std::span<const std::size_t> top() const { return top_; }

 private:
  void take(const cholmod_factor_struct& factor, int block_size, int end_row);
  void add(Supernode node, std::span<const int> rows);
  void find_subtrees();

  std::vector<int> order_;
  std::vector<Supernode> supernodes_;
  std::size_t eliminated_count_ = 0;
  std::vector<int> rows_;
  std::vector<int> supernode_of_column_;
  std::size_t value_count_ = 0;
  int max_rows_ = 0;  ///< of a block
  std::vector<Subtree> subtrees_;
  std::vector<std::size_t> top_;
};

}  // namespace flexneck::fe_modal
