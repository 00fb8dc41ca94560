// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/supernodal_factor.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <type_traits>
#include <utility>

#include "fe_modal/algebra/block_elimination.h"
#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/algebra/supernodal_elimination.h"
#include "geometry/foundation/in_parallel.h"

namespace flexneck::fe_modal {
template <typename Scalar>
SupernodalFactor<Scalar>::SupernodalFactor(CholmodAnalysis& analysis, unsigned threads,
                                           std::span<const int> kept, Pivots pivots)
    : tree_(analysis.places(), analysis.block_size(), kept) {
  number_ancestor_rows();
  try {
    const LowerHalf matrix = analysis.lower_half();
    values_ = std::make_unique_for_overwrite<Scalar[]>(tree_.value_count());
    const std::span<Scalar> values(values_.get(), tree_.value_count());
    complement_ = pivots == Pivots::positive
                      ? factorise(tree_, matrix, values, threads)
                      : factorise_with_signs(tree_, matrix, values, signs_, threads);
    find_smallest_pivot(matrix);
  } catch (const std::bad_alloc&) {
    throw no_memory_for_factor();
  }
}

template <typename Scalar>
template <typename Other>
SupernodalFactor<Scalar>::SupernodalFactor(SupernodalFactor<Other>&& other)
    : tree_(std::move(other.tree_)),
      rows_(std::move(other.rows_)),
      values_(std::make_unique_for_overwrite<Scalar[]>(tree_.value_count())),
      signs_(other.signs_.begin(), other.signs_.end()),
      smallest_pivot_(other.smallest_pivot_) {
  std::transform(other.values_.get(), other.values_.get() + tree_.value_count(), values_.get(),
                 [](Other value) { return static_cast<Scalar>(value); });
}

template <typename Scalar>
void SupernodalFactor<Scalar>::find_smallest_pivot(const LowerHalf& matrix) {
  for (const Supernode& node : tree_.eliminated()) {
    const Scalar* root = values_.get() + node.block;
    for (int j = node.first; j < node.end(); ++j, root += node.rows + 1) {
      const double entry = matrix.values[as_index(matrix.offsets[as_index(j)])];
      const double pivot = static_cast<double>(*root) * *root;
      smallest_pivot_ = std::min(smallest_pivot_, pivot / std::abs(entry));
    }
  }
}

template <typename Scalar>
Eigen::Index SupernodalFactor<Scalar>::negative_pivots() const {
  return std::count(signs_.begin(), signs_.end(), Scalar(-1));
}

template <typename Scalar>
void SupernodalFactor<Scalar>::number_ancestor_rows() {
  rows_.assign(tree_.row_lists().begin(), tree_.row_lists().end());
  std::vector<int> numbers(tree_.order().size());
  for (const Subtree& subtree : tree_.subtrees()) {
    for (std::size_t k = 0; k < subtree.ancestors.size(); ++k) {
      numbers[as_index(subtree.ancestors[k])] = subtree.end_row + static_cast<int>(k);
    }
    for (const Supernode& node :
         tree_.supernodes().subspan(subtree.begin, subtree.end - subtree.begin)) {
      std::transform(tree_.rows_of(node).begin(), tree_.rows_of(node).end(),
                     rows_.begin() + static_cast<std::ptrdiff_t>(node.row_list),
                     [&](int row) { return row < subtree.end_row ? row : numbers[as_index(row)]; });
    }
  }
}

/// Columns on their way through the factor.
template <typename Scalar>
template <std::size_t lanes>
class SupernodalFactor<Scalar>::Solve {
 public:
  static constexpr auto kWidth = static_cast<Eigen::Index>(lanes);

  explicit Solve(const SupernodalFactor& factor)
      : factor_(factor), tree_(factor.tree_), x_(tree_.order().size()) {
    for (const Subtree& subtree : tree_.subtrees()) {
      ancestor_x_.emplace_back(subtree.ancestors.size());
    }
  }

  auto columns() {
    using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, kWidth, Eigen::RowMajor>;
    return Eigen::Map<RowMajor>(x_.front().value, static_cast<Eigen::Index>(x_.size()), kWidth);
  }

  void eliminate(unsigned threads) {
    const std::span<const Subtree> subtrees = tree_.subtrees();
    in_parallel(subtrees.size(), threads,
                [&](std::size_t b) { forward(subtrees[b], ancestor_x_[b]); });
    for (std::size_t b = 0; b < subtrees.size(); ++b) {
      for (std::size_t k = 0; k < ancestor_x_[b].size(); ++k) {
        add(ancestor_x_[b][k], x_[as_index(subtrees[b].ancestors[k])]);
      }
    }
    Workspace top = workspace(static_cast<int>(x_.size()), nullptr);
    for (const std::size_t k : tree_.top()) forward(tree_.supernodes()[k], top);
  }

  void substitute(unsigned threads) {
    for (std::size_t k = 0; k < factor_.signs_.size(); ++k) {
      if (factor_.signs_[k] < 0) turn(x_[k]);
    }
    Workspace top = workspace(static_cast<int>(x_.size()), nullptr);
    for (std::size_t k = tree_.top().size(); k-- > 0;) {
      backward(tree_.supernodes()[tree_.top()[k]], top);
    }
    const std::span<const Subtree> subtrees = tree_.subtrees();
    in_parallel(subtrees.size(), threads,
                [&](std::size_t b) { backward(subtrees[b], ancestor_x_[b]); });
  }

 private:
  using Row = RowOf<Scalar, lanes>;

  /// Where a subtree, or the top, finds the rows of its lists.
  struct Workspace {
    Row* x;
    int end_row;
    Row* ancestors;
    std::vector<Row> block_x;

    Row& at(int row) { return row < end_row ? x[row] : ancestors[row - end_row]; }
  };
  Workspace workspace(int end_row, Row* ancestors) {
    return {x_.data(), end_row, ancestors, std::vector<Row>(as_index(tree_.max_rows()))};
  }

  static void add(const Row& more, Row& sum) {
    for (std::size_t c = 0; c < lanes; ++c) sum.value[c] += more.value[c];
  }

  static void turn(Row& row) {
    for (std::size_t c = 0; c < lanes; ++c) row.value[c] = -row.value[c];
  }

  void forward(const Subtree& subtree, std::vector<Row>& ancestors) {
    std::fill(ancestors.begin(), ancestors.end(), Row{});
    Workspace places = workspace(subtree.end_row, ancestors.data());
    for (std::size_t k = subtree.begin; k < subtree.end; ++k) {
      forward(tree_.supernodes()[k], places);
    }
  }
  void forward(const Supernode& node, Workspace& places) const {
    Row* const block_x = places.block_x.data();
    std::copy_n(places.x + node.first, node.columns, block_x);
    std::fill_n(block_x + node.columns, node.rows - node.columns, Row{});
    fe_modal::eliminate(
        FactorBlock<Scalar>{factor_.values_.get() + node.block, node.rows, node.columns}, block_x);
    std::copy_n(block_x, node.columns, places.x + node.first);
    const int* const rows = factor_.rows_.data() + node.row_list;
    for (int i = node.columns; i < node.rows; ++i) add(block_x[i], places.at(rows[i]));
  }

  void backward(const Subtree& subtree, std::vector<Row>& ancestors) {
    for (std::size_t k = 0; k < ancestors.size(); ++k)
      ancestors[k] = x_[as_index(subtree.ancestors[k])];
    Workspace places = workspace(subtree.end_row, ancestors.data());
    for (std::size_t k = subtree.end; k-- > subtree.begin;) {
      backward(tree_.supernodes()[k], places);
    }
  }
  void backward(const Supernode& node, Workspace& places) const {
    Row* const block_x = places.block_x.data();
    const int* const rows = factor_.rows_.data() + node.row_list;
    for (int i = 0; i < node.rows; ++i) block_x[i] = places.at(rows[i]);
    fe_modal::substitute(
        FactorBlock<Scalar>{factor_.values_.get() + node.block, node.rows, node.columns}, block_x);
    std::copy_n(block_x, node.columns, places.x + node.first);
  }

  const SupernodalFactor& factor_;
  const SupernodeTree& tree_;
  std::vector<Row> x_;
  std::vector<std::vector<Row>> ancestor_x_;  ///< of each subtree
};

template <typename Scalar>
template <std::size_t lanes, typename Work>
void SupernodalFactor<Scalar>::by_lanes(Matrix& x, const Work& work) const {
  Solve<lanes> together(*this);
  constexpr Eigen::Index kWidth = Solve<lanes>::kWidth;
  for (Eigen::Index first = 0; first < x.cols(); first += kWidth) {
    const Eigen::Index width = std::min(kWidth, x.cols() - first);
    together.columns().leftCols(width) = x.middleCols(first, width);
    together.columns().rightCols(kWidth - width).setZero();
    work(together);
    x.middleCols(first, width) = together.columns().leftCols(width);
  }
}

template <typename Scalar>
template <typename Work>
void SupernodalFactor<Scalar>::by_lanes(Matrix& x, const Work& work) const {
  if (x.size() == 0) return;
  if constexpr (std::is_same_v<Scalar, float>) {
    if (x.cols() > static_cast<Eigen::Index>(kColumnsTogether)) {
      return by_lanes<kSinglesTogether>(x, work);
    }
  }
  by_lanes<kColumnsTogether>(x, work);
}

template <typename Scalar>
void SupernodalFactor<Scalar>::solve(Matrix& x, unsigned threads) const {
  by_lanes(x, [&](auto& columns) {
    columns.eliminate(threads);
    columns.substitute(threads);
  });
}

template <typename Scalar>
Eigen::MatrixXd SupernodalFactor<Scalar>::solution(const Eigen::MatrixXd& right_hand_sides,
                                                   unsigned threads) const {
  Matrix x = right_hand_sides(order(), Eigen::all).template cast<Scalar>();
  solve(x, threads);
  Eigen::MatrixXd solutions(x.rows(), x.cols());
  solutions(order(), Eigen::all) = x.template cast<double>();
  return solutions;
}

template <typename Scalar>
void SupernodalFactor<Scalar>::eliminate(Matrix& x, unsigned threads) const {
  by_lanes(x, [&](auto& columns) { columns.eliminate(threads); });
}

template <typename Scalar>
void SupernodalFactor<Scalar>::substitute(Matrix& x, unsigned threads) const {
  by_lanes(x, [&](auto& columns) { columns.substitute(threads); });
}

template class SupernodalFactor<double>;
template class SupernodalFactor<float>;
template SupernodalFactor<float>::SupernodalFactor(SupernodalFactor<double>&& other);

}  // namespace flexneck::fe_modal
