// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/packed_matrix.h"

#include <algorithm>

namespace flexneck::fe_modal {
namespace {

/// Rows that are worked on together. With as many groups as kGroups they take twelve registers of
/// the sixteen that there are at least.
constexpr std::size_t kTogether = 3;
template <typename Row>
constexpr std::size_t kGroups = 4 / Row::kRegisters;

/// Some rows of y, of which there are stored as many as there are.
struct Strip {
  const double* values;  ///< (columns, kTogether)
  std::size_t columns;
  std::size_t stored;
};

template <typename Row, std::size_t count>
[[gnu::always_inline]] inline void multiply_strip(const Strip& strip, const RowOf<double>* x,
                                                  std::size_t groups, RowOf<double>* y) {
  Row sums[kTogether][count];
  for (std::size_t c = 0; c < strip.columns; ++c) {
    const double* const factors = strip.values + c * kTogether;
    for (std::size_t g = 0; g < count; ++g) {
      Row row;
      row.load(x[c * groups + g]);
      for (std::size_t r = 0; r < kTogether; ++r) sums[r][g].add(factors[r], row);
    }
  }
  for (std::size_t r = 0; r < strip.stored; ++r) {
    for (std::size_t g = 0; g < count; ++g) sums[r][g].store(y[r * groups + g]);
  }
}

/// The first groups of x and y, count of them at a time.
/// @return how many groups were done
template <typename Row, std::size_t count>
[[gnu::always_inline]] inline std::size_t multiply_groups(const std::vector<double>& values,
                                                          std::size_t rows, std::size_t columns,
                                                          const RowOf<double>* x, std::size_t first,
                                                          std::size_t groups, RowOf<double>* y) {
  for (; first + count <= groups; first += count) {
    for (std::size_t r = 0; r < rows; r += kTogether) {
      const Strip strip{values.data() + r * columns, columns, std::min(kTogether, rows - r)};
      multiply_strip<Row, count>(strip, x + first, groups, y + r * groups + first);
    }
  }
  return first;
}

}  // namespace

PackedMatrix::PackedMatrix(const Eigen::MatrixXd& matrix)
    : rows_(static_cast<std::size_t>(matrix.rows())),
      columns_(static_cast<std::size_t>(matrix.cols())) {
  const std::size_t strips = (rows_ + kTogether - 1) / kTogether;
  values_.assign(strips * kTogether * columns_, 0);
  for (std::size_t r = 0; r < rows_; ++r) {
    double* const strip = values_.data() + r / kTogether * kTogether * columns_;
    for (std::size_t c = 0; c < columns_; ++c) {
      strip[c * kTogether + r % kTogether] =
          matrix(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
    }
  }
}

void PackedMatrix::multiply(const RowOf<double>* x, std::size_t groups, RowOf<double>* y,
                            VectorRegisters registers) const {
  run_with(
      registers, [&]<std::size_t bytes>() __attribute__((always_inline)) {
        using Row = RegisterRow<double, bytes>;
        constexpr std::size_t kMost = kGroups<Row>;
        std::size_t first = multiply_groups<Row, kMost>(values_, rows_, columns_, x, 0, groups, y);
        if constexpr (kMost > 2) {
          first = multiply_groups<Row, 2>(values_, rows_, columns_, x, first, groups, y);
        }
        multiply_groups<Row, 1>(values_, rows_, columns_, x, first, groups, y);
      });
}

}  // namespace flexneck::fe_modal
