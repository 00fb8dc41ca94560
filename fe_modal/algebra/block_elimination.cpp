// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/block_elimination.h"

#include <algorithm>

namespace flexneck::fe_modal {
namespace {

/// Columns of a block that belong to a node, of which most blocks are made.
constexpr int kNode = 3;
constexpr int kRowsFetched = 8;  ///< a line of the cache, in single precision half of it

/// Columns of a block that are worked on together: their rows take at most twelve registers of the
/// sixteen that there are at least.
template <typename Row>
constexpr int kPanel = Row::kRegisters <= 2 ? 2 * kNode : kNode;

template <typename Row>
using RowOfSame = RowOf<typename Row::Scalar, Row::kLanes>;

/// Some columns of a block, from their diagonal down. The next, and the ones before, follow in
/// memory, mostly those of another block, and so they are fetched while these are worked on: the
/// processor by itself foresees no more than the rest of a page.
template <typename Scalar>
struct Columns {
  const Scalar* values;
  std::ptrdiff_t stride;
  int rows;

  [[gnu::always_inline]] Scalar at(int row, int column) const {
    return values[column * stride + row];
  }
  template <int count>
  [[gnu::always_inline]] void fetch(int row, int columns_away) const {
    for (int c = 0; c < count; ++c) {
      __builtin_prefetch(values + (columns_away + c) * stride + row);
    }
  }
};

template <typename Row, int count>
[[gnu::always_inline]] inline void eliminate_columns(const Columns<typename Row::Scalar>& columns,
                                                     RowOfSame<Row>* x) {
  Row own[count];
  for (int c = 0; c < count; ++c) {
    own[c].load(x[c]);
    for (int b = 0; b < c; ++b) own[c].subtract(columns.at(c, b), own[b]);
    own[c].divide(columns.at(c, c));
    own[c].store(x[c]);
  }
  const auto take_from = [&](int i) __attribute__((always_inline)) {
    Row row;
    row.load(x[i]);
    for (int c = 0; c < count; ++c) row.subtract(columns.at(i, c), own[c]);
    row.store(x[i]);
  };
  int i = count;
  for (; i + kRowsFetched <= columns.rows; i += kRowsFetched) {
    columns.template fetch<count>(i, count);
    for (int k = 0; k < kRowsFetched; ++k) take_from(i + k);
  }
  for (; i < columns.rows; ++i) take_from(i);
}

template <typename Row, int count>
[[gnu::always_inline]] inline void substitute_columns(const Columns<typename Row::Scalar>& columns,
                                                      RowOfSame<Row>* x) {
  Row own[count];
  for (int c = 0; c < count; ++c) own[c].load(x[c]);
  const auto take = [&](int i) __attribute__((always_inline)) {
    Row row;
    row.load(x[i]);
    for (int c = 0; c < count; ++c) own[c].subtract(columns.at(i, c), row);
  };
  int i = count;
  for (; i + kRowsFetched <= columns.rows; i += kRowsFetched) {
    columns.template fetch<count>(i, -count);
    for (int k = 0; k < kRowsFetched; ++k) take(i + k);
  }
  for (; i < columns.rows; ++i) take(i);
  for (int c = count - 1; c >= 0; --c) {
    for (int b = c + 1; b < count; ++b) own[c].subtract(columns.at(b, c), own[b]);
    own[c].divide(columns.at(c, c));
    own[c].store(x[c]);
  }
}

template <typename Scalar>
[[gnu::always_inline]] inline Columns<Scalar> columns_from(const FactorBlock<Scalar>& block,
                                                           int first) {
  const std::ptrdiff_t stride = block.rows;
  return {block.values + first * stride + first, stride, block.rows - first};
}

template <typename Row>
[[gnu::always_inline]] inline void eliminate_with(const FactorBlock<typename Row::Scalar>& block,
                                                  RowOfSame<Row>* x) {
  int j = 0;
  for (; j + kPanel<Row> <= block.columns; j += kPanel<Row>) {
    eliminate_columns<Row, kPanel<Row>>(columns_from(block, j), x + j);
  }
  for (; j + kNode <= block.columns; j += kNode) {
    eliminate_columns<Row, kNode>(columns_from(block, j), x + j);
  }
  for (; j < block.columns; ++j) eliminate_columns<Row, 1>(columns_from(block, j), x + j);
}

template <typename Row>
[[gnu::always_inline]] inline void substitute_with(const FactorBlock<typename Row::Scalar>& block,
                                                   RowOfSame<Row>* x) {
  int j = block.columns;
  for (; j % kNode != 0; --j) {
    substitute_columns<Row, 1>(columns_from(block, j - 1), x + j - 1);
  }
  for (; j % kPanel<Row> != 0; j -= kNode) {
    substitute_columns<Row, kNode>(columns_from(block, j - kNode), x + j - kNode);
  }
  for (; j > 0; j -= kPanel<Row>) {
    substitute_columns<Row, kPanel<Row>>(columns_from(block, j - kPanel<Row>), x + j - kPanel<Row>);
  }
}

}  // namespace

template <typename Scalar, std::size_t lanes>
void eliminate(const FactorBlock<Scalar>& block, RowOf<Scalar, lanes>* x,
               VectorRegisters registers) {
  run_with(
      registers, [&]<std::size_t bytes>() __attribute__((always_inline)) {
        eliminate_with<RegisterRow<Scalar, bytes, lanes>>(block, x);
      });
}

template <typename Scalar, std::size_t lanes>
void substitute(const FactorBlock<Scalar>& block, RowOf<Scalar, lanes>* x,
                VectorRegisters registers) {
  run_with(
      registers, [&]<std::size_t bytes>() __attribute__((always_inline)) {
        substitute_with<RegisterRow<Scalar, bytes, lanes>>(block, x);
      });
}

template void eliminate(const FactorBlock<double>&, RowOf<double>*, VectorRegisters);
template void eliminate(const FactorBlock<float>&, RowOf<float>*, VectorRegisters);
template void eliminate(const FactorBlock<float>&, RowOf<float, kSinglesTogether>*,
                        VectorRegisters);
template void substitute(const FactorBlock<double>&, RowOf<double>*, VectorRegisters);
template void substitute(const FactorBlock<float>&, RowOf<float>*, VectorRegisters);
template void substitute(const FactorBlock<float>&, RowOf<float, kSinglesTogether>*,
                         VectorRegisters);

}  // namespace flexneck::fe_modal
