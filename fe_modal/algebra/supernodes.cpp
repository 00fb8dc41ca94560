// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/supernodes.h"

#include <algorithm>
#include <cholmod.h>
#include <numeric>

#include "fe_modal/algebra/block_elimination.h"
#include "geometry/foundation/in_parallel.h"

namespace flexneck::fe_modal {
namespace {

constexpr auto kEight = static_cast<Eigen::Index>(kColumnsTogether);
/// A subtree with a larger share of the factor's entries is divided: eight subtrees at least for
/// threads. With 1/32 two threads took 6 % longer at 191 000 degrees of freedom, for the top of the
/// tree, which one thread solves, is larger.
constexpr double kMaxShareOfSubtree = 1.0 / 8;
/// Entries of a factor that is too small to be shared out: its solve takes some 0.1 ms, as the
/// start of a few threads.
constexpr double kFewEntries = 1e5;

/// CHOLMOD counts rows by int.
constexpr std::size_t index(int row) { return static_cast<std::size_t>(row); }

}  // namespace

Supernodes::Supernodes(const cholmod_factor_struct& factor) {
  const auto list = [](const void* data, std::size_t count) {
    return std::span(static_cast<const int*>(data), count);
  };
  const auto order = list(factor.Perm, factor.n);
  const auto rows = list(factor.s, factor.ssize);
  const auto columns = list(factor.super, factor.nsuper + 1);
  const auto row_lists = list(factor.pi, factor.nsuper + 1);
  const auto blocks = list(factor.px, factor.nsuper + 1);
  order_.assign(order.begin(), order.end());
  rows_.assign(rows.begin(), rows.end());
  for (std::size_t k = 0; k < factor.nsuper; ++k) {
    const int count = row_lists[k + 1] - row_lists[k];
    supernodes_.push_back(
        {columns[k], columns[k + 1] - columns[k], count, index(row_lists[k]), index(blocks[k])});
    max_rows_ = std::max(max_rows_, count);
  }
  find_subtrees();
  number_ancestor_rows();
}

void Supernodes::find_subtrees() {
  const std::size_t count = supernodes_.size();
  std::vector<std::size_t> supernode_of(order_.size());
  for (std::size_t k = 0; k < count; ++k) {
    for (int j = supernodes_[k].first; j < supernodes_[k].end(); ++j) supernode_of[index(j)] = k;
  }
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
    if (node.rows == node.columns) {
      candidates.push_back(k);
      continue;
    }
    const std::size_t parent = supernode_of[index(rows_of(node)[node.columns])];
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
          {first[k], k + 1, root.end(), {rows_of(root) + root.columns, rows_of(root) + root.rows}});
    } else {
      top_.push_back(k);
      candidates.insert(candidates.end(), children[k].begin(), children[k].end());
    }
  }
  std::sort(top_.begin(), top_.end());
  std::sort(subtrees_.begin(), subtrees_.end(),
            [](const Subtree& one, const Subtree& other) { return one.begin < other.begin; });
}

void Supernodes::number_ancestor_rows() {
  std::vector<int> numbers(order_.size());
  for (const Subtree& subtree : subtrees_) {
    for (std::size_t k = 0; k < subtree.ancestors.size(); ++k) {
      numbers[index(subtree.ancestors[k])] = subtree.end_row + static_cast<int>(k);
    }
    for (std::size_t k = subtree.begin; k < subtree.end; ++k) {
      const Supernode& node = supernodes_[k];
      for (int& row : std::span(rows_).subspan(node.row_list, index(node.rows))) {
        if (row >= subtree.end_row) row = numbers[index(row)];
      }
    }
  }
}

/// Eight columns on their way through the factor.
template <typename Scalar>
class Supernodes::Solve {
 public:
  Solve(const Supernodes& factor, const Scalar* values)
      : factor_(factor), values_(values), x_(factor.order_.size()) {
    for (const Subtree& subtree : factor.subtrees_)
      ancestor_x_.emplace_back(subtree.ancestors.size());
  }

  auto columns() {
    using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, kEight, Eigen::RowMajor>;
    return Eigen::Map<RowMajor>(x_.front().value, static_cast<Eigen::Index>(x_.size()), kEight);
  }

  void run(unsigned threads) {
    const std::vector<Subtree>& subtrees = factor_.subtrees_;
    in_parallel(subtrees.size(), threads,
                [&](std::size_t b) { forward(subtrees[b], ancestor_x_[b]); });
    for (std::size_t b = 0; b < subtrees.size(); ++b) {
      for (std::size_t k = 0; k < ancestor_x_[b].size(); ++k) {
        add(ancestor_x_[b][k], x_[index(subtrees[b].ancestors[k])]);
      }
    }
    Workspace top = workspace(static_cast<int>(x_.size()), nullptr);
    for (const std::size_t k : factor_.top_) forward(factor_.supernodes_[k], top);
    for (std::size_t k = factor_.top_.size(); k-- > 0;) {
      backward(factor_.supernodes_[factor_.top_[k]], top);
    }
    in_parallel(subtrees.size(), threads,
                [&](std::size_t b) { backward(subtrees[b], ancestor_x_[b]); });
  }

 private:
  using Row = RowOf<Scalar>;

  /// Where a subtree, or the top, finds the rows of its lists.
  struct Workspace {
    Row* x;
    int end_row;
    Row* ancestors;
    std::vector<Row> block_x;

    Row& at(int row) { return row < end_row ? x[row] : ancestors[row - end_row]; }
  };
  Workspace workspace(int end_row, Row* ancestors) {
    return {x_.data(), end_row, ancestors, std::vector<Row>(index(factor_.max_rows_))};
  }

  static void add(const Row& more, Row& sum) {
    for (Eigen::Index c = 0; c < kEight; ++c) sum.value[c] += more.value[c];
  }

  void forward(const Subtree& subtree, std::vector<Row>& ancestors) {
    std::fill(ancestors.begin(), ancestors.end(), Row{});
    Workspace places = workspace(subtree.end_row, ancestors.data());
    for (std::size_t k = subtree.begin; k < subtree.end; ++k) {
      forward(factor_.supernodes_[k], places);
    }
  }
  void forward(const Supernode& node, Workspace& places) const {
    Row* const block_x = places.block_x.data();
    std::copy_n(places.x + node.first, node.columns, block_x);
    std::fill_n(block_x + node.columns, node.rows - node.columns, Row{});
    eliminate(FactorBlock<Scalar>{values_ + node.block, node.rows, node.columns}, block_x);
    std::copy_n(block_x, node.columns, places.x + node.first);
    const int* const rows = factor_.rows_of(node);
    for (int i = node.columns; i < node.rows; ++i) add(block_x[i], places.at(rows[i]));
  }

  void backward(const Subtree& subtree, std::vector<Row>& ancestors) {
    for (std::size_t k = 0; k < ancestors.size(); ++k)
      ancestors[k] = x_[index(subtree.ancestors[k])];
    Workspace places = workspace(subtree.end_row, ancestors.data());
    for (std::size_t k = subtree.end; k-- > subtree.begin;) {
      backward(factor_.supernodes_[k], places);
    }
  }
  void backward(const Supernode& node, Workspace& places) const {
    Row* const block_x = places.block_x.data();
    const int* const rows = factor_.rows_of(node);
    for (int i = 0; i < node.rows; ++i) block_x[i] = places.at(rows[i]);
    substitute(FactorBlock<Scalar>{values_ + node.block, node.rows, node.columns}, block_x);
    std::copy_n(block_x, node.columns, places.x + node.first);
  }

  const Supernodes& factor_;
  const Scalar* values_;
  std::vector<Row> x_;
  std::vector<std::vector<Row>> ancestor_x_;  ///< of each subtree
};

void Supernodes::solve(std::span<const double> values, Eigen::MatrixXd& x, unsigned threads) const {
  solve_by_eight<double>(values, x, threads);
}

void Supernodes::solve(std::span<const float> values, Eigen::MatrixXf& x, unsigned threads) const {
  solve_by_eight<float>(values, x, threads);
}

template <typename Scalar, typename Matrix>
void Supernodes::solve_by_eight(std::span<const Scalar> values, Matrix& x, unsigned threads) const {
  if (x.size() == 0) return;
  Solve<Scalar> eight(*this, values.data());
  for (Eigen::Index first = 0; first < x.cols(); first += kEight) {
    const Eigen::Index width = std::min(kEight, x.cols() - first);
    eight.columns().leftCols(width) = x.middleCols(first, width);
    eight.columns().rightCols(kEight - width).setZero();
    eight.run(threads);
    x.middleCols(first, width) = eight.columns().leftCols(width);
  }
}

}  // namespace flexneck::fe_modal
