// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/block_product.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/algebra/register_row.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kMultiplying = "multiplying with a matrix";
/// y = A x by the upper half of A; three rows a node.
template <typename Row>
[[gnu::always_inline]] inline void multiply_rows(const SymmetricProduct& product,
                                                 std::span<const RowOf<double, Row::kLanes>> x,
                                                 std::span<RowOf<double, Row::kLanes>> y) {
  const SymmetricMatrix& matrix = product.matrix();
  std::fill(y.begin(), y.end(), RowOf<double, Row::kLanes>{});
  for (std::size_t node = 0; 3 * node < x.size(); ++node) {
    Row own[3];
    Row sum[3] = {};
    const double* entries[3];
    for (std::size_t a = 0; a < 3; ++a) own[a].load(x[3 * node + a]);
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) sum[a].add(product.block_sum(node)[3 * a + b], own[b]);
      entries[a] = matrix.values().data() + matrix.offsets()[3 * node + a] + (3 - a);
    }
    for (const std::int32_t other : matrix.later(static_cast<std::int32_t>(node))) {
      const auto place = 3 * static_cast<std::size_t>(other);
      Row against[3];  // what the other moves against this one
      for (std::size_t b = 0; b < 3; ++b) {
        against[b].load(x[place + b]);
        against[b].subtract(1, own[b]);
      }
      for (std::size_t b = 0; b < 3; ++b) {
        Row result;
        result.load(y[place + b]);
        for (std::size_t a = 0; a < 3; ++a) {
          sum[a].add(entries[a][b], against[b]);
          result.subtract(entries[a][b], against[a]);
        }
        result.store(y[place + b]);
      }
      for (const double*& next : entries) next += 3;
    }
    for (std::size_t a = 0; a < 3; ++a) {
      Row result;
      result.load(y[3 * node + a]);
      result.add(1, sum[a]);
      result.store(y[3 * node + a]);
    }
  }
}

/// y = M x.
template <typename Row>
[[gnu::always_inline]] inline void multiply_rows(const NodalMass& mass,
                                                 std::span<const RowOf<double, Row::kLanes>> x,
                                                 std::span<RowOf<double, Row::kLanes>> y) {
  for (std::size_t node = 0; 3 * node < x.size(); ++node) {
    Row sum[3] = {};
    for (std::int32_t k = mass.outerIndexPtr()[node]; k < mass.outerIndexPtr()[node + 1]; ++k) {
      const auto place = 3 * static_cast<std::size_t>(mass.innerIndexPtr()[k]);
      for (std::size_t a = 0; a < 3; ++a) {
        Row other;
        other.load(x[place + a]);
        sum[a].add(mass.valuePtr()[k], other);
      }
    }
    for (std::size_t a = 0; a < 3; ++a) sum[a].store(y[3 * node + a]);
  }
}

template <typename Matrix>
void multiply_rows(const Matrix& matrix, std::span<const RowOf<double, 1>> x,
                   std::span<RowOf<double, 1>> y) {
  multiply_rows<SingleRow>(matrix, x, y);
}
template <typename Matrix>
void multiply_rows(const Matrix& matrix, std::span<const RowOf<double>> x,
                   std::span<RowOf<double>> y) {
  run_with(
      widest_registers(), [&]<std::size_t bytes>() __attribute__((always_inline)) {
        multiply_rows<RegisterRow<double, bytes>>(matrix, x, y);
      });
}

/// The product with so many columns at a time.
template <std::size_t lanes, typename Matrix>
void multiply_by_lanes(const Matrix& matrix, const Eigen::Ref<const Eigen::MatrixXd>& columns,
                       Eigen::Ref<Eigen::MatrixXd> result) {
  if (columns.size() == 0) return;
  constexpr auto kLanes = static_cast<Eigen::Index>(lanes);
  const auto rows = static_cast<std::size_t>(columns.rows());
  const auto in = std::make_unique_for_overwrite<RowOf<double, lanes>[]>(rows);
  const auto out = std::make_unique_for_overwrite<RowOf<double, lanes>[]>(rows);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, kLanes, lanes == 1 ? 0 : Eigen::RowMajor>;
  Eigen::Map<Rows> in_rows(in.get()->value, columns.rows(), kLanes);
  const Eigen::Map<const Rows> out_rows(out.get()->value, columns.rows(), kLanes);
  for (Eigen::Index first = 0; first < columns.cols(); first += kLanes) {
    const Eigen::Index width = std::min(kLanes, columns.cols() - first);
    in_rows.leftCols(width) = columns.middleCols(first, width);
    in_rows.rightCols(kLanes - width).setZero();
    multiply_rows(matrix, std::span<const RowOf<double, lanes>>(in.get(), rows),
                  std::span(out.get(), rows));
    result.middleCols(first, width) = out_rows.leftCols(width);
  }
}

template <typename Matrix>
Eigen::MatrixXd product(const Matrix& matrix, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  // A few columns by themselves take less time than eight of which most are empty.
  const Eigen::Index rest = columns.cols() % static_cast<Eigen::Index>(kColumnsTogether);
  const Eigen::Index alone = rest < 3 ? rest : 0;
  multiply_by_lanes<kColumnsTogether>(matrix, columns.leftCols(columns.cols() - alone),
                                      result.leftCols(columns.cols() - alone));
  multiply_by_lanes<1>(matrix, columns.rightCols(alone), result.rightCols(alone));
  return result;
}

}  // namespace

VecHandle column_vector(const Eigen::MatrixXd& columns, Eigen::Index column, const Ranks& ranks) {
  return vector_on({columns.col(column).data(), static_cast<std::size_t>(columns.rows())}, ranks);
}

Eigen::MatrixXd block_product(Mat matrix, const Eigen::MatrixXd& columns) {
  if (const BlockOperator* const apply = operator_behind(matrix)) return (*apply)(columns);
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const VecHandle in = column_vector(columns, k);
    const VecHandle out = column_vector(result, k);
    require(MatMult(matrix, in.get(), out.get()), kMultiplying);
  }
  return result;
}

SymmetricProduct::SymmetricProduct(const SymmetricMatrix& matrix) : matrix_(&matrix) {
  const auto nodes = static_cast<std::size_t>(matrix.size()) / 3;
  // They are what is left of entries that cancel.
  std::vector<long double> sums(9 * nodes);
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto number = static_cast<std::int32_t>(node);
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        sums[9 * node + static_cast<std::size_t>(3 * a + b)] +=
            matrix.entry(number, std::min(a, b), -1, std::max(a, b));
      }
    }
    std::ptrdiff_t place = 0;
    for (const std::int32_t other : matrix.later(number)) {
      const auto there = static_cast<std::size_t>(other);
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          const double entry = matrix.entry(number, a, place, b);
          sums[9 * node + static_cast<std::size_t>(3 * a + b)] += entry;
          sums[9 * there + static_cast<std::size_t>(3 * b + a)] += entry;
        }
      }
      ++place;
    }
  }
  block_sums_.reserve(sums.size());
  for (const long double sum : sums) block_sums_.push_back(static_cast<double>(sum));
}

Eigen::MatrixXd SymmetricProduct::operator()(const Eigen::MatrixXd& columns) const {
  return product(*this, columns);
}

Eigen::MatrixXd block_product(const NodalMass& mass, const Eigen::MatrixXd& columns) {
  return product(mass, columns);
}

}  // namespace flexneck::fe_modal
