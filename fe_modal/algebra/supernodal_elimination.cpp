// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/supernodal_elimination.h"

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "fe_modal/algebra/blas.h"
#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/signed_cholesky.h"
#include "fe_modal/algebra/update_lists.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/in_parallel.h"

namespace flexneck::fe_modal {
namespace {

/// Rows of a supernode that a thread takes at a time: by 256 the BLAS spends a tenth more on
/// packing the other factor of the product, by 2048 few threads find work.
constexpr int kStripRows = 768;

/// Of a list, entries [begin, end).
struct Range {
  int begin;
  int end;

  int size() const { return end - begin; }
};

/// Rows of a block that are worked on at a time: those of its diagonal, then so many below it.
std::vector<Range> strips_of(const Supernode& node) {
  std::vector<Range> strips = {{0, node.columns}};
  for (int begin = node.columns; begin < node.rows; begin += kStripRows) {
    strips.push_back({begin, std::min(begin + kStripRows, node.rows)});
  }
  return strips;
}

/// What a thread works with.
template <typename Scalar>
struct Workspace {
  explicit Workspace(std::size_t rows) : positions(rows) {}

  std::vector<int> positions;  ///< of rows in a block
  std::vector<int> targets;    ///< of the rows of an update
  std::vector<Scalar> product;
  std::vector<Scalar> turned;
};

template <typename Scalar>
class Elimination {
 public:
  Elimination(const SupernodeTree& tree, const LowerHalf& matrix, std::span<Scalar> values,
              Pivots pivots)
      : tree_(tree),
        matrix_(matrix),
        pivots_(pivots),
        updates_(tree),
        signs_(pivots == Pivots::positive ? 0 : tree.order().size(), Scalar(1)),
        has_negative_(tree.supernodes().size(), 0) {
    for (const Supernode& node : tree.eliminated()) blocks_.push_back(values.data() + node.block);
    for (const Supernode& node : tree.kept()) {
      blocks_.push_back(
          complement_.emplace_back(as_index(node.rows) * as_index(node.columns)).data());
    }
  }

  void run(unsigned threads) {
    threads = std::max(1U, threads);
    std::vector<Workspace<Scalar>> workspaces(threads, Workspace<Scalar>(tree_.order().size()));
    // Calls work(k, workspace) for all k.
    const auto share_out = [&](std::size_t count, const auto& work) {
      std::atomic<std::size_t> next = 0;
      in_parallel(std::min<std::size_t>(threads, count), threads, [&](std::size_t thread) {
        call_blas_alone();
        for (std::size_t k = next++; k < count; k = next++) work(k, workspaces[thread]);
      });
    };
    share_out(tree_.subtrees().size(), [&](std::size_t b, Workspace<Scalar>& workspace) {
      const Subtree& subtree = tree_.subtrees()[b];
      for (std::size_t k = subtree.begin; k < subtree.end; ++k) eliminate(k, workspace);
    });
    const auto assemble_strips = [&](std::size_t k, const std::vector<Range>& strips) {
      share_out(strips.size(), [&](std::size_t s, Workspace<Scalar>& workspace) {
        assemble(k, strips[s], workspace);
      });
    };
    for (const std::size_t k : tree_.top()) {
      const std::vector<Range> strips = strips_of(tree_.supernodes()[k]);
      assemble_strips(k, strips);
      find_diagonal(k, workspaces.front());
      share_out(strips.size(),
                [&](std::size_t s, Workspace<Scalar>&) { divide_by_diagonal(k, strips[s]); });
    }
    for (std::size_t k = tree_.eliminated_count(); k < tree_.supernodes().size(); ++k) {
      assemble_strips(k, strips_of(tree_.supernodes()[k]));
    }
  }

  SchurComplement<Scalar> take_complement() { return std::move(complement_); }
  std::vector<Scalar> take_signs() { return std::move(signs_); }

 private:
  void eliminate(std::size_t k, Workspace<Scalar>& workspace) {
    const Supernode& node = tree_.supernodes()[k];
    const Range below{node.columns, node.rows};
    assemble(k, {0, node.columns}, workspace);
    if (below.size() > 0) assemble(k, below, workspace);
    find_diagonal(k, workspace);
    if (below.size() > 0) divide_by_diagonal(k, below);
  }

  DenseBlock<Scalar> block_of(std::size_t k) const {
    const Supernode& node = tree_.supernodes()[k];
    return {blocks_[k], node.rows, node.columns, node.rows};
  }

  /// The strip's entries of A, less the updates of the descendants.
  void assemble(std::size_t k, Range strip, Workspace<Scalar>& workspace) const {
    const Supernode& node = tree_.supernodes()[k];
    const auto rows = tree_.rows_of(node);
    for (int i = strip.begin; i < strip.end; ++i)
      workspace.positions[as_index(rows[as_index(i)])] = i;
    const int first_row = rows[as_index(strip.begin)];
    const int last_row = rows[as_index(strip.end - 1)];
    for (int j = 0; j < node.columns; ++j) {
      Scalar* const column = block_of(k).column(j);
      std::fill(column + strip.begin, column + strip.end, Scalar(0));
      const auto begin = as_index(matrix_.offsets[as_index(node.first + j)]);
      const auto end = as_index(matrix_.offsets[as_index(node.first + j) + 1]);
      const auto rows_of_column = matrix_.rows.subspan(begin, end - begin);
      const auto first = std::lower_bound(rows_of_column.begin(), rows_of_column.end(), first_row);
      for (auto row = first; row != rows_of_column.end() && *row <= last_row; ++row) {
        const auto place = begin + static_cast<std::size_t>(row - rows_of_column.begin());
        column[workspace.positions[as_index(*row)]] = static_cast<Scalar>(matrix_.values[place]);
      }
    }
    for (const Update& update : updates_.of(k)) subtract(update, k, strip, workspace);
  }

  /// Subtracts L_i S L_j^T of the descendant's rows i in the strip and its rows j in the columns.
  void subtract(const Update& update, std::size_t k, Range strip,
                Workspace<Scalar>& workspace) const {
    const Supernode& node = tree_.supernodes()[k];
    const Range columns{update.begin, update.end};
    if (strip.begin < node.columns) {
      return subtract(update.descendant, columns, columns, k, workspace);
    }
    const auto rows = tree_.rows_of(tree_.supernodes()[as_index(update.descendant)]);
    const auto own = tree_.rows_of(node);
    const auto place_of = [&](int row) {
      return static_cast<int>(std::lower_bound(rows.begin() + update.end, rows.end(), row) -
                              rows.begin());
    };
    const Range in_strip{place_of(own[as_index(strip.begin)]),
                         place_of(own[as_index(strip.end - 1)] + 1)};
    if (in_strip.size() > 0) subtract(update.descendant, in_strip, columns, k, workspace);
  }

  /// @param rows, columns in the descendant's list; of the same only the lower half matters
  void subtract(int descendant, Range rows, Range columns, std::size_t k,
                Workspace<Scalar>& workspace) const {
    const Supernode& node = tree_.supernodes()[k];
    const auto list = tree_.rows_of(tree_.supernodes()[as_index(descendant)]);
    const bool is_triangle = rows.begin == columns.begin;
    workspace.targets.clear();
    for (const int row : list.subspan(as_index(rows.begin), as_index(rows.size()))) {
      workspace.targets.push_back(workspace.positions[as_index(row)]);
    }
    const int* const targets = workspace.targets.data();
    const auto row_at = [&](int i) { return targets[i]; };
    const auto column_at = [&](int j) { return list[as_index(columns.begin + j)] - node.first; };
    const auto are_neighbours = [](Range range, const auto& place_at) {
      return place_at(range.size() - 1) - place_at(0) == range.size() - 1;
    };
    if (are_neighbours(rows, row_at) && are_neighbours(columns, column_at)) {
      add_product(Scalar(-1), descendant, rows, columns, Scalar(1),
                  block_of(k).part(row_at(0), column_at(0), rows.size(), columns.size()),
                  workspace);
      return;
    }
    const DenseBlock<Scalar> product = room_for(rows.size(), columns.size(), workspace.product);
    add_product(Scalar(1), descendant, rows, columns, Scalar(0), product, workspace);
    for (int j = 0; j < columns.size(); ++j) {
      Scalar* const target = block_of(k).column(column_at(j));
      const Scalar* const values = product.column(j);
      for (int i = is_triangle ? j : 0; i < rows.size(); ++i) target[targets[i]] -= values[i];
    }
  }

  /// result = factor L_i S L_j^T + keep result
  void add_product(Scalar factor, int descendant, Range rows, Range columns, Scalar keep,
                   const DenseBlock<Scalar>& result, Workspace<Scalar>& workspace) const {
    const Supernode& from = tree_.supernodes()[as_index(descendant)];
    const auto rows_of = [&](Range range) -> DenseBlock<const Scalar> {
      return block_of(as_index(descendant)).part(range.begin, 0, range.size(), from.columns);
    };
    const bool has_negative = has_negative_[as_index(descendant)] != 0;
    if (!has_negative && rows.begin == columns.begin) {
      return multiply_by_own_transpose(factor, rows_of(rows), keep, result);
    }
    const auto signs = has_negative ? signs_of(from) : std::span<const Scalar>();
    multiply_with_signs(factor, rows_of(rows), signs, rows_of(columns), keep, result,
                        workspace.turned);
  }

  /// Those of the supernode's pivots; none where all pivots must be positive.
  std::span<const Scalar> signs_of(const Supernode& node) const {
    if (signs_.empty()) return {};
    return std::span(signs_).subspan(as_index(node.first), as_index(node.columns));
  }

  void find_diagonal(std::size_t k, Workspace<Scalar>& workspace) {
    const Supernode& node = tree_.supernodes()[k];
    const DenseBlock<Scalar> diagonal = block_of(k).part(0, 0, node.columns, node.columns);
    const auto signs =
        signs_.empty() ? std::span<Scalar>()
                       : std::span(signs_).subspan(as_index(node.first), as_index(node.columns));
    has_negative_[k] = factorise_diagonal(diagonal, pivots_, signs, workspace.product) ? 1 : 0;
  }

  void divide_by_diagonal(std::size_t k, Range strip) const {
    const Supernode& node = tree_.supernodes()[k];
    if (strip.begin < node.columns) return;
    const DenseBlock<Scalar> block = block_of(k);
    const DenseBlock<Scalar> below = block.part(strip.begin, 0, strip.size(), node.columns);
    divide_by_transpose(DenseBlock<const Scalar>(block.part(0, 0, node.columns, node.columns)),
                        below);
    if (has_negative_[k] != 0) {
      turn_columns<Scalar>(below, signs_of(node));
    }
  }

  const SupernodeTree& tree_;
  const LowerHalf& matrix_;
  Pivots pivots_;
  UpdateLists updates_;
  std::vector<Scalar*> blocks_;  ///< of the supernodes and of kept rows
  SchurComplement<Scalar> complement_;
  std::vector<Scalar> signs_;       ///< of the pivots, if any may be negative
  std::vector<char> has_negative_;  ///< by supernode; not bool, for threads write them
};

}  // namespace

template <typename Scalar>
SchurComplement<Scalar> factorise(const SupernodeTree& tree, const LowerHalf& matrix,
                                  std::span<Scalar> values, unsigned threads) {
  Elimination<Scalar> elimination(tree, matrix, values, Pivots::positive);
  elimination.run(threads);
  return elimination.take_complement();
}

template SchurComplement<double> factorise(const SupernodeTree&, const LowerHalf&,
                                           std::span<double>, unsigned);
template SchurComplement<float> factorise(const SupernodeTree&, const LowerHalf&, std::span<float>,
                                          unsigned);

template <typename Scalar>
SchurComplement<Scalar> factorise_with_signs(const SupernodeTree& tree, const LowerHalf& matrix,
                                             std::span<Scalar> values, std::vector<Scalar>& signs,
                                             unsigned threads) {
  Elimination<Scalar> elimination(tree, matrix, values, Pivots::of_any_sign);
  elimination.run(threads);
  signs = elimination.take_signs();
  return elimination.take_complement();
}

template SchurComplement<double> factorise_with_signs(const SupernodeTree&, const LowerHalf&,
                                                      std::span<double>, std::vector<double>&,
                                                      unsigned);
template SchurComplement<float> factorise_with_signs(const SupernodeTree&, const LowerHalf&,
                                                     std::span<float>, std::vector<float>&,
                                                     unsigned);

}  // namespace flexneck::fe_modal
