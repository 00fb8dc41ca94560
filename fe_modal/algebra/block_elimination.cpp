// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/block_elimination.h"

#include <algorithm>

namespace flexneck::fe_modal {
namespace {

/// Columns of a block that belong to a node, of which most blocks are made.
constexpr int kNode = 3;
constexpr int kRowsFetched = 8;  ///< a line of the cache, in single precision half of it

/// A row of eight in registers of so many bytes. Wider ones than the processor has would be taken
/// apart number by number.
template <typename Number, std::size_t bytes>
struct RegisterRow {
  using Scalar = Number;
  // An attribute, since no type of the standard is a register.
  typedef Scalar Register __attribute__((vector_size(bytes), may_alias));
  static constexpr std::size_t kRegisters = sizeof(RowOfEight<Scalar>) / bytes;
  /// Columns of a block that are worked on together: their rows take twelve registers of the
  /// sixteen that there are at least.
  static constexpr int kPanel = kRegisters <= 2 ? 2 * kNode : kNode;

  Register part[kRegisters];

  [[gnu::always_inline]] void load(const RowOfEight<Scalar>& row) {
    for (std::size_t k = 0; k < kRegisters; ++k) {
      part[k] = reinterpret_cast<const Register*>(row.value)[k];
    }
  }
  [[gnu::always_inline]] void store(RowOfEight<Scalar>& row) const {
    for (std::size_t k = 0; k < kRegisters; ++k) {
      reinterpret_cast<Register*>(row.value)[k] = part[k];
    }
  }
  [[gnu::always_inline]] void subtract(Scalar factor, const RegisterRow& other) {
    for (std::size_t k = 0; k < kRegisters; ++k) part[k] -= factor * other.part[k];
  }
  [[gnu::always_inline]] void divide(Scalar divisor) {
    for (std::size_t k = 0; k < kRegisters; ++k) part[k] /= divisor;
  }
};

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
                                                     RowOfEight<typename Row::Scalar>* x) {
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
                                                      RowOfEight<typename Row::Scalar>* x) {
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
                                                  RowOfEight<typename Row::Scalar>* x) {
  int j = 0;
  for (; j + Row::kPanel <= block.columns; j += Row::kPanel) {
    eliminate_columns<Row, Row::kPanel>(columns_from(block, j), x + j);
  }
  for (; j + kNode <= block.columns; j += kNode) {
    eliminate_columns<Row, kNode>(columns_from(block, j), x + j);
  }
  for (; j < block.columns; ++j) eliminate_columns<Row, 1>(columns_from(block, j), x + j);
}

template <typename Row>
[[gnu::always_inline]] inline void substitute_with(const FactorBlock<typename Row::Scalar>& block,
                                                   RowOfEight<typename Row::Scalar>* x) {
  int j = block.columns;
  for (; j % kNode != 0; --j) {
    substitute_columns<Row, 1>(columns_from(block, j - 1), x + j - 1);
  }
  for (; j % Row::kPanel != 0; j -= kNode) {
    substitute_columns<Row, kNode>(columns_from(block, j - kNode), x + j - kNode);
  }
  for (; j > 0; j -= Row::kPanel) {
    substitute_columns<Row, Row::kPanel>(columns_from(block, j - Row::kPanel), x + j - Row::kPanel);
  }
}

#ifdef __x86_64__
template <typename Scalar>
[[gnu::target("avx2,fma")]] void eliminate_by_32_bytes(const FactorBlock<Scalar>& block,
                                                       RowOfEight<Scalar>* x) {
  eliminate_with<RegisterRow<Scalar, 32>>(block, x);
}
template <typename Scalar>
[[gnu::target("avx2,fma")]] void substitute_by_32_bytes(const FactorBlock<Scalar>& block,
                                                        RowOfEight<Scalar>* x) {
  substitute_with<RegisterRow<Scalar, 32>>(block, x);
}
#endif

template <typename Scalar>
void eliminate_block(const FactorBlock<Scalar>& block, RowOfEight<Scalar>* x,
                     [[maybe_unused]] VectorRegisters registers) {
#ifdef __x86_64__
  if (registers == VectorRegisters::of_32_bytes) return eliminate_by_32_bytes(block, x);
#endif
  eliminate_with<RegisterRow<Scalar, 16>>(block, x);
}

template <typename Scalar>
void substitute_block(const FactorBlock<Scalar>& block, RowOfEight<Scalar>* x,
                      [[maybe_unused]] VectorRegisters registers) {
#ifdef __x86_64__
  if (registers == VectorRegisters::of_32_bytes) return substitute_by_32_bytes(block, x);
#endif
  substitute_with<RegisterRow<Scalar, 16>>(block, x);
}

}  // namespace

VectorRegisters widest_registers() {
#ifdef __x86_64__
  static const bool has_32_bytes = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (has_32_bytes) return VectorRegisters::of_32_bytes;
#endif
  return VectorRegisters::of_16_bytes;
}

void eliminate(const FactorBlock<double>& block, RowOfEight<double>* x, VectorRegisters registers) {
  eliminate_block(block, x, registers);
}
void eliminate(const FactorBlock<float>& block, RowOfEight<float>* x, VectorRegisters registers) {
  eliminate_block(block, x, registers);
}
void substitute(const FactorBlock<double>& block, RowOfEight<double>* x,
                VectorRegisters registers) {
  substitute_block(block, x, registers);
}
void substitute(const FactorBlock<float>& block, RowOfEight<float>* x, VectorRegisters registers) {
  substitute_block(block, x, registers);
}

}  // namespace flexneck::fe_modal
