// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/supernodes.h"

#include <algorithm>

#include "fe_modal/algebra/vector_clones.h"

namespace flexneck::fe_modal {
namespace {

/// Columns of x that are worked on together, a row of them in one or two registers. The block's
/// are taken four at a time, whose rows of x stay there.
constexpr int kWidth = 8;
constexpr int kPanel = 4;

template <typename Scalar>
struct alignas(kWidth * sizeof(Scalar)) RowOf {
  // An attribute, since no type of the standard is a register.
  typedef Scalar Type __attribute__((vector_size(kWidth * sizeof(Scalar))));
  Type row;
};

using Supernode = Supernodes::Supernode;

/// The block's own rows of x become L^-1 x, `below` becomes what the rows below lose by that.
template <typename Scalar, typename Row>
[[gnu::always_inline]] inline void eliminate(const Supernode& node, const Scalar* block, Row* own,
                                             Row* below) {
  const int more = node.rows - node.columns;
  for (int i = 0; i < more; ++i) below[i] = Row{};
  int j = 0;
  for (; j + kPanel <= node.columns; j += kPanel) {
    const Scalar* const a = block + static_cast<std::size_t>(j) * node.rows;
    const Scalar* const b = a + node.rows;
    const Scalar* const c = b + node.rows;
    const Scalar* const d = c + node.rows;
    const Row x0 = own[j] / a[j];
    const Row x1 = (own[j + 1] - a[j + 1] * x0) / b[j + 1];
    const Row x2 = (own[j + 2] - a[j + 2] * x0 - b[j + 2] * x1) / c[j + 2];
    const Row x3 = (own[j + 3] - a[j + 3] * x0 - b[j + 3] * x1 - c[j + 3] * x2) / d[j + 3];
    own[j] = x0;
    own[j + 1] = x1;
    own[j + 2] = x2;
    own[j + 3] = x3;
    for (int i = j + kPanel; i < node.columns; ++i) {
      own[i] -= a[i] * x0 + b[i] * x1 + c[i] * x2 + d[i] * x3;
    }
    for (int i = 0; i < more; ++i) {
      const int r = node.columns + i;
      below[i] += a[r] * x0 + b[r] * x1 + c[r] * x2 + d[r] * x3;
    }
  }
  for (; j < node.columns; ++j) {
    const Scalar* const a = block + static_cast<std::size_t>(j) * node.rows;
    const Row x0 = own[j] / a[j];
    own[j] = x0;
    for (int i = j + 1; i < node.columns; ++i) own[i] -= a[i] * x0;
    for (int i = 0; i < more; ++i) below[i] += a[node.columns + i] * x0;
  }
}

/// The block's own rows of x become those of L^-T x, of which the rows below are known.
template <typename Scalar, typename Row>
[[gnu::always_inline]] inline void substitute(const Supernode& node, const Scalar* block, Row* own,
                                              const Row* below) {
  const int more = node.rows - node.columns;
  int j = node.columns;
  for (; j % kPanel != 0; --j) {
    const Scalar* const a = block + static_cast<std::size_t>(j - 1) * node.rows;
    Row sum = own[j - 1];
    for (int i = j; i < node.columns; ++i) sum -= a[i] * own[i];
    for (int i = 0; i < more; ++i) sum -= a[node.columns + i] * below[i];
    own[j - 1] = sum / a[j - 1];
  }
  for (; j > 0; j -= kPanel) {
    const int k = j - kPanel;
    const Scalar* const a = block + static_cast<std::size_t>(k) * node.rows;
    const Scalar* const b = a + node.rows;
    const Scalar* const c = b + node.rows;
    const Scalar* const d = c + node.rows;
    Row s0 = own[k];
    Row s1 = own[k + 1];
    Row s2 = own[k + 2];
    Row s3 = own[k + 3];
    const auto subtract = [&](int i, const Row& x) __attribute__((always_inline)) {
      s0 -= a[i] * x;
      s1 -= b[i] * x;
      s2 -= c[i] * x;
      s3 -= d[i] * x;
    };
    for (int i = j; i < node.columns; ++i) subtract(i, own[i]);
    for (int i = 0; i < more; ++i) subtract(node.columns + i, below[i]);
    s3 /= d[k + 3];
    s2 = (s2 - c[k + 3] * s3) / c[k + 2];
    s1 = (s1 - b[k + 2] * s2 - b[k + 3] * s3) / b[k + 1];
    s0 = (s0 - a[k + 1] * s1 - a[k + 2] * s2 - a[k + 3] * s3) / a[k];
    own[k] = s0;
    own[k + 1] = s1;
    own[k + 2] = s2;
    own[k + 3] = s3;
  }
}

/// x = (L L^T)^-1 x.
/// @param below room for the rows below any block
template <typename Scalar, typename Row>
[[gnu::always_inline]] inline void solve_inline(std::span<const Supernode> supernodes,
                                                const int* rows, const Scalar* values, Row* x,
                                                Row* below) {
  for (const Supernode& node : supernodes) {
    eliminate(node, values + node.block, x + node.first, below);
    const int* const places = rows + node.row_list + node.columns;
    for (int i = 0; i < node.rows - node.columns; ++i) x[places[i]] -= below[i];
  }
  for (std::size_t k = supernodes.size(); k-- > 0;) {
    const Supernode& node = supernodes[k];
    const int* const places = rows + node.row_list + node.columns;
    for (int i = 0; i < node.rows - node.columns; ++i) below[i] = x[places[i]];
    substitute(node, values + node.block, x + node.first, below);
  }
}

FLEXNECK_VECTOR_CLONES void solve_eight(std::span<const Supernode> supernodes, const int* rows,
                                        const double* values, RowOf<double>* x,
                                        RowOf<double>* below) {
  solve_inline(supernodes, rows, values, &x->row, &below->row);
}
FLEXNECK_VECTOR_CLONES void solve_eight(std::span<const Supernode> supernodes, const int* rows,
                                        const float* values, RowOf<float>* x, RowOf<float>* below) {
  solve_inline(supernodes, rows, values, &x->row, &below->row);
}

template <typename Scalar, typename Matrix>
void solve_all(std::span<const Supernode> supernodes, const int* rows, const Scalar* values,
               Matrix& x) {
  int most = 0;
  for (const Supernode& node : supernodes) most = std::max(most, node.rows - node.columns);
  std::vector<RowOf<Scalar>> eight(static_cast<std::size_t>(x.rows()));
  std::vector<RowOf<Scalar>> below(static_cast<std::size_t>(most));
  using RowMajor = Eigen::Matrix<Scalar, Eigen::Dynamic, kWidth, Eigen::RowMajor>;
  Eigen::Map<RowMajor> columns(reinterpret_cast<Scalar*>(eight.data()), x.rows(), kWidth);
  for (Eigen::Index first = 0; first < x.cols(); first += kWidth) {
    const Eigen::Index width = std::min<Eigen::Index>(kWidth, x.cols() - first);
    columns.leftCols(width) = x.middleCols(first, width);
    columns.rightCols(kWidth - width).setZero();
    solve_eight(supernodes, rows, values, eight.data(), below.data());
    x.middleCols(first, width) = columns.leftCols(width);
  }
}

}  // namespace

Supernodes::Supernodes(const cholmod_factor& factor) {
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
    supernodes_.push_back({columns[k], columns[k + 1] - columns[k], row_lists[k + 1] - row_lists[k],
                           static_cast<std::size_t>(row_lists[k]),
                           static_cast<std::size_t>(blocks[k])});
  }
}

void Supernodes::solve(std::span<const double> values, Eigen::MatrixXd& x) const {
  solve_all(supernodes_, rows_.data(), values.data(), x);
}

void Supernodes::solve(std::span<const float> values, Eigen::MatrixXf& x) const {
  solve_all(supernodes_, rows_.data(), values.data(), x);
}

}  // namespace flexneck::fe_modal
