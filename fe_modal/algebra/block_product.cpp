// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/block_product.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fe_modal/algebra/operator_matrix.h"
#include "fe_modal/algebra/vector_clones.h"

namespace flexneck::fe_modal {
namespace {

constexpr const char* kMultiplying = "multiplying with a matrix";
constexpr std::size_t kTogether = 8;  ///< columns: as many numbers as the widest register holds
/// A node's three rows of so many columns.
template <std::size_t lanes>
using ThreeRows = std::array<std::array<double, lanes>, 3>;
using ThreeEntries = std::array<const double*, 3>;

/// sum += A x and y += A^T x', with the 3 x 3 block A whose rows begin at `entries`.
template <std::size_t lanes>
[[gnu::always_inline]] inline void multiply_both_ways(const ThreeEntries& entries,
                                                      const ThreeRows<lanes>& x,
                                                      ThreeRows<lanes>& __restrict sum,
                                                      const ThreeRows<lanes>& own_x,
                                                      ThreeRows<lanes>& __restrict y) {
  const auto& [a, b, c] = entries;
  for (std::size_t k = 0; k < lanes; ++k) {
    sum[0][k] += a[0] * x[0][k] + a[1] * x[1][k] + a[2] * x[2][k];
    sum[1][k] += b[0] * x[0][k] + b[1] * x[1][k] + b[2] * x[2][k];
    sum[2][k] += c[0] * x[0][k] + c[1] * x[1][k] + c[2] * x[2][k];
    y[0][k] += a[0] * own_x[0][k] + b[0] * own_x[1][k] + c[0] * own_x[2][k];
    y[1][k] += a[1] * own_x[0][k] + b[1] * own_x[1][k] + c[1] * own_x[2][k];
    y[2][k] += a[2] * own_x[0][k] + b[2] * own_x[1][k] + c[2] * own_x[2][k];
  }
}

/// y += A x by the upper half of A.
template <std::size_t lanes>
[[gnu::always_inline]] inline void add_product_inline(const SymmetricMatrix& matrix,
                                                      const std::vector<ThreeRows<lanes>>& x,
                                                      std::vector<ThreeRows<lanes>>& y) {
  for (std::size_t node = 0; node < x.size(); ++node) {
    const ThreeRows<lanes> own = x[node];
    ThreeRows<lanes> sum{};
    ThreeEntries entries{};
    for (std::size_t a = 0; a < 3; ++a) {
      const double* const row =
          matrix.values().data() + matrix.offsets()[3 * node + a];  // begins on the diagonal
      for (std::size_t b = a; b < 3; ++b) {
        const double entry = row[b - a];
        for (std::size_t k = 0; k < lanes; ++k) {
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
      for (std::size_t k = 0; k < lanes; ++k) y[node][a][k] += sum[a][k];
    }
  }
}

/// y = M x.
template <std::size_t lanes>
[[gnu::always_inline]] inline void add_product_inline(const NodalMass& mass,
                                                      const std::vector<ThreeRows<lanes>>& x,
                                                      std::vector<ThreeRows<lanes>>& y) {
  for (std::size_t row = 0; row < x.size(); ++row) {
    ThreeRows<lanes> sum{};
    for (std::int32_t k = mass.outerIndexPtr()[row]; k < mass.outerIndexPtr()[row + 1]; ++k) {
      const double entry = mass.valuePtr()[k];
      const ThreeRows<lanes>& other = x[static_cast<std::size_t>(mass.innerIndexPtr()[k])];
      for (std::size_t a = 0; a < 3; ++a) {
        for (std::size_t c = 0; c < lanes; ++c) sum[a][c] += entry * other[a][c];
      }
    }
    y[row] = sum;
  }
}

// One column fills no vector; eight are compiled for each width.
template <typename Matrix>
void add_product(const Matrix& matrix, const std::vector<ThreeRows<1>>& x,
                 std::vector<ThreeRows<1>>& y) {
  add_product_inline(matrix, x, y);
}
FLEXNECK_VECTOR_CLONES void add_product(const SymmetricMatrix& matrix,
                                        const std::vector<ThreeRows<kTogether>>& x,
                                        std::vector<ThreeRows<kTogether>>& y) {
  add_product_inline(matrix, x, y);
}
FLEXNECK_VECTOR_CLONES void add_product(const NodalMass& mass,
                                        const std::vector<ThreeRows<kTogether>>& x,
                                        std::vector<ThreeRows<kTogether>>& y) {
  add_product_inline(mass, x, y);
}

/// The product with so many columns at a time.
template <std::size_t lanes, typename Matrix>
void multiply_by_lanes(const Matrix& matrix, const Eigen::Ref<const Eigen::MatrixXd>& columns,
                       Eigen::Ref<Eigen::MatrixXd> result) {
  if (columns.size() == 0) return;
  constexpr auto kLanes = static_cast<Eigen::Index>(lanes);
  std::vector<ThreeRows<lanes>> in(static_cast<std::size_t>(columns.rows() / 3));
  std::vector<ThreeRows<lanes>> out(in.size());
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, kLanes, lanes == 1 ? 0 : Eigen::RowMajor>;
  Eigen::Map<Rows> in_rows(in.front().front().data(), columns.rows(), kLanes);
  const Eigen::Map<const Rows> out_rows(out.front().front().data(), columns.rows(), kLanes);
  for (Eigen::Index first = 0; first < columns.cols(); first += kLanes) {
    const Eigen::Index width = std::min(kLanes, columns.cols() - first);
    in_rows.leftCols(width) = columns.middleCols(first, width);
    std::fill(out.begin(), out.end(), ThreeRows<lanes>{});
    add_product(matrix, in, out);
    result.middleCols(first, width) = out_rows.leftCols(width);
  }
}

template <typename Matrix>
Eigen::MatrixXd product(const Matrix& matrix, const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  // A few columns by themselves take less time than eight of which most are empty.
  const Eigen::Index rest = columns.cols() % static_cast<Eigen::Index>(kTogether);
  const Eigen::Index alone = rest < 3 ? rest : 0;
  multiply_by_lanes<kTogether>(matrix, columns.leftCols(columns.cols() - alone),
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

Eigen::MatrixXd block_product(const SymmetricMatrix& matrix, const Eigen::MatrixXd& columns) {
  return product(matrix, columns);
}

Eigen::MatrixXd block_product(const NodalMass& mass, const Eigen::MatrixXd& columns) {
  return product(mass, columns);
}

}  // namespace flexneck::fe_modal
