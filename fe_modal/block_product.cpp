// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/block_product.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace flexneck::fe_modal {
namespace {

constexpr Eigen::Index kTogether = 8;
/// Some columns row by row, so that those of a degree of freedom are neighbours.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, kTogether, Eigen::RowMajor>;
using ThreeRows = std::array<double, 3 * kTogether>;

/// to += factor * from, a row each.
void add_row(double factor, const double* from, double* to) {
  for (Eigen::Index k = 0; k < kTogether; ++k) to[k] += factor * from[k];
}

/// The rows of one node: own diagonal block, then each later node both ways.
void multiply_node(const SymmetricMatrix& matrix, std::int32_t node, const Rows& in, Rows& out) {
  const double* const own = in.data() + 3 * kTogether * static_cast<std::ptrdiff_t>(node);
  ThreeRows sum{};
  std::array<const double*, 3> values{};
  for (std::ptrdiff_t a = 0; a < 3; ++a) {
    const auto row = static_cast<std::size_t>(3 * node + a);
    values[static_cast<std::size_t>(a)] =
        matrix.values().data() + matrix.offsets()[row] - a;  // so that column b stands at b
    for (std::ptrdiff_t b = a; b < 3; ++b) {
      const double entry = values[static_cast<std::size_t>(a)][b];
      add_row(entry, own + kTogether * b, sum.data() + kTogether * a);
      if (b != a) add_row(entry, own + kTogether * a, sum.data() + kTogether * b);
    }
  }
  for (const std::int32_t other : matrix.later(node)) {
    const double* const theirs = in.data() + 3 * kTogether * static_cast<std::ptrdiff_t>(other);
    double* const response = out.data() + 3 * kTogether * static_cast<std::ptrdiff_t>(other);
    for (std::ptrdiff_t a = 0; a < 3; ++a) {
      const double* const entries = values[static_cast<std::size_t>(a)] += 3;
      for (std::ptrdiff_t b = 0; b < 3; ++b) {
        add_row(entries[b], theirs + kTogether * b, sum.data() + kTogether * a);
        add_row(entries[b], own + kTogether * a, response + kTogether * b);
      }
    }
  }
  double* const result = out.data() + 3 * kTogether * static_cast<std::ptrdiff_t>(node);
  for (std::size_t k = 0; k < sum.size(); ++k) result[k] += sum[k];
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
  Rows in = Rows::Zero(columns.rows(), kTogether);
  Rows out(columns.rows(), kTogether);
  for (Eigen::Index first = 0; first < columns.cols(); first += kTogether) {
    const Eigen::Index width = std::min(kTogether, columns.cols() - first);
    in.leftCols(width) = columns.middleCols(first, width);
    out.setZero();
    for (std::int32_t node = 0; node < matrix.size() / 3; ++node) {
      multiply_node(matrix, node, in, out);
    }
    result.middleCols(first, width) = out.leftCols(width);
  }
  return result;
}

}  // namespace flexneck::fe_modal
