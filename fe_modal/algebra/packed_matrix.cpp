// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/packed_matrix.h"

#include <algorithm>

namespace flexneck::fe_modal {
namespace {

/// Rows that are worked on together, a strip. With as many groups as kGroups they take twelve
/// registers of the sixteen that there are at least.
constexpr std::size_t kMostRows = 3;
template <typename Row>
constexpr std::size_t kGroups = 4 / Row::kRegisters;

/// Of the rows from the first of a strip on those that it has: two and two rather than three and
/// one, since a row alone would wait for each of its sums.
constexpr std::size_t rows_of_strip(std::size_t left) {
  return left == kMostRows + 1 ? 2 : std::min(kMostRows, left);
}

/// @param values (columns, height) of the strip
template <typename Row, std::size_t count, std::size_t height>
[[gnu::always_inline]] inline void multiply_strip(const double* values, std::size_t columns,
                                                  const RowOf<double>* x, std::size_t groups,
                                                  RowOf<double>* y) {
  Row sums[height][count] = {};
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t g = 0; g < count; ++g) {
      Row row;
      row.load(x[c * groups + g]);
      for (std::size_t r = 0; r < height; ++r) sums[r][g].add(values[c * height + r], row);
    }
  }
  for (std::size_t r = 0; r < height; ++r) {
    for (std::size_t g = 0; g < count; ++g) sums[r][g].store(y[r * groups + g]);
  }
}

/// The first groups of x and y, count of them at a time.
/// @return how many groups were done
template <typename Row, std::size_t count>
[[gnu::always_inline]] inline std::size_t multiply_groups(const double* values, std::size_t rows,
                                                          std::size_t columns,
                                                          const RowOf<double>* x, std::size_t first,
                                                          std::size_t groups, RowOf<double>* y) {
  for (; first + count <= groups; first += count) {
    for (std::size_t r = 0; r < rows;) {
      const double* const strip = values + r * columns;
      RowOf<double>* const to = y + r * groups + first;
      const std::size_t height = rows_of_strip(rows - r);
      if (height == 3) multiply_strip<Row, count, 3>(strip, columns, x + first, groups, to);
      if (height == 2) multiply_strip<Row, count, 2>(strip, columns, x + first, groups, to);
      if (height == 1) multiply_strip<Row, count, 1>(strip, columns, x + first, groups, to);
      r += height;
    }
  }
  return first;
}

}  // namespace

PackedMatrix::PackedMatrix(const Eigen::MatrixXd& matrix)
    : rows_(static_cast<std::size_t>(matrix.rows())),
      columns_(static_cast<std::size_t>(matrix.cols())),
      values_((rows_ * columns_ + kColumnsTogether - 1) / kColumnsTogether) {
  for (Eigen::Index r = 0; r < matrix.rows();) {
    const auto height =
        static_cast<Eigen::Index>(rows_of_strip(rows_ - static_cast<std::size_t>(r)));
    Eigen::Map<Eigen::MatrixXd>(values_.front().value + r * matrix.cols(), height, matrix.cols()) =
        matrix.middleRows(r, height);
    r += height;
  }
}

void PackedMatrix::multiply(const RowOf<double>* x, std::size_t groups, RowOf<double>* y,
                            VectorRegisters registers) const {
  run_with(
      registers, [&]<std::size_t bytes>() __attribute__((always_inline)) {
        using Row = RegisterRow<double, bytes>;
        constexpr std::size_t kMost = kGroups<Row>;
        const double* const values = values_.front().value;
        std::size_t first = multiply_groups<Row, kMost>(values, rows_, columns_, x, 0, groups, y);
        if constexpr (kMost > 2) {
          first = multiply_groups<Row, 2>(values, rows_, columns_, x, first, groups, y);
        }
        multiply_groups<Row, 1>(values, rows_, columns_, x, first, groups, y);
      });
}

}  // namespace flexneck::fe_modal
