// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/block_product.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace flexneck::fe_modal {
namespace {

constexpr Eigen::Index kTogether = 8;
/// Of so many columns the entries in one row.
using Lanes = std::array<double, kTogether>;
using ThreeRows = std::array<Lanes, 3>;
using ThreeEntries = std::array<const double*, 3>;

/// sum += A x and y += A^T x', with the 3 x 3 block A whose rows begin at `entries`.
void multiply_both_ways(const ThreeEntries& entries, const ThreeRows& x, ThreeRows& sum,
                        const ThreeRows& own_x, ThreeRows& y) {
  const auto& [a, b, c] = entries;
#pragma GCC ivdep
  for (std::size_t k = 0; k < kTogether; ++k) {
    sum[0][k] += a[0] * x[0][k] + a[1] * x[1][k] + a[2] * x[2][k];
    sum[1][k] += b[0] * x[0][k] + b[1] * x[1][k] + b[2] * x[2][k];
    sum[2][k] += c[0] * x[0][k] + c[1] * x[1][k] + c[2] * x[2][k];
    y[0][k] += a[0] * own_x[0][k] + b[0] * own_x[1][k] + c[0] * own_x[2][k];
    y[1][k] += a[1] * own_x[0][k] + b[1] * own_x[1][k] + c[1] * own_x[2][k];
    y[2][k] += a[2] * own_x[0][k] + b[2] * own_x[1][k] + c[2] * own_x[2][k];
  }
}

/// y += A x by the upper half of A.
void add_product(const SymmetricMatrix& matrix, const std::vector<ThreeRows>& x,
                 std::vector<ThreeRows>& y) {
  for (std::size_t node = 0; node < x.size(); ++node) {
    const ThreeRows own = x[node];
    ThreeRows sum{};
    ThreeEntries entries{};
    for (std::size_t a = 0; a < 3; ++a) {
      const double* const row =
          matrix.values().data() + matrix.offsets()[3 * node + a];  // begins on the diagonal
      for (std::size_t b = a; b < 3; ++b) {
        const double entry = row[b - a];
        for (std::size_t k = 0; k < kTogether; ++k) {
          sum[a][k] += entry * own[b][k];
          if (b != a) sum[b][k] += entry * own[a][k];
        }
      }
      entries[a] = row + (3 - a);
    }
    for (const std::int32_t other : matrix.later(static_cast<std::int32_t>(node))) {
      const auto place = static_cast<std::size_t>(other);
      multiply_both_ways(entries, x[place], sum, own, y[place]);
      for (const double*& next : entries) next += 3;
    }
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t k = 0; k < kTogether; ++k) y[node][a][k] += sum[a][k];
    }
  }
}

}  // namespace

VecHandle column_vector(const Eigen::MatrixXd& columns, Eigen::Index column) {
  return vector_on({columns.col(column).data(), static_cast<std::size_t>(columns.rows())});
}

Eigen::MatrixXd block_product(Mat matrix, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const VecHandle in = column_vector(columns, k);
    const VecHandle out = column_vector(result, k);
    require(MatMult(matrix, in.get(), out.get()), "multiplying with a matrix");
  }
  return result;
}

Eigen::MatrixXd block_product(const SymmetricMatrix& matrix, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  const Eigen::Index nodes = columns.rows() / 3;
  std::vector<ThreeRows> in(static_cast<std::size_t>(nodes));
  std::vector<ThreeRows> out(in.size());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, kTogether, Eigen::RowMajor>;
  Eigen::Map<Rows> in_rows(in.front().front().data(), 3 * nodes, kTogether);
  const Eigen::Map<const Rows> out_rows(out.front().front().data(), 3 * nodes, kTogether);
  for (Eigen::Index first = 0; first < columns.cols(); first += kTogether) {
    const Eigen::Index width = std::min(kTogether, columns.cols() - first);
    in_rows.leftCols(width) = columns.middleCols(first, width);
    std::fill(out.begin(), out.end(), ThreeRows{});
    add_product(matrix, in, out);
    result.middleCols(first, width) = out_rows.leftCols(width);
  }
  return result;
}

}  // namespace flexneck::fe_modal
