// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/inertia_count.h"

#include <cmath>

#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/algebra/random_block.h"
#include "fe_modal/algebra/supernodal_factor.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

template <typename Scalar>
std::optional<Eigen::Index> count_by_factor(CholmodAnalysis& analysis, Mat product,
                                            unsigned threads) {
  try {
    const SupernodalFactor<Scalar> factor(analysis, threads_in_blas(threads), {},
                                          Pivots::of_any_sign);
    const auto inverse = [&](const Eigen::MatrixXd& x) { return factor.solution(x, threads); };
    if (has_inertia_of_factor({}, product, inverse)) return factor.negative_pivots();
  } catch (const ComputationError&) {  // a pivot is zero
  }
  return std::nullopt;
}

}  // namespace

bool has_inertia_of_factor(const Ranks& ranks, Mat matrix, const BlockOperator& inverse) {
  constexpr Eigen::Index kColumns = 8;  // which a factor takes together
  constexpr std::uint64_t kSeed = 20240611;
  // Calibrated: with 200 000 rows as long as half a factor in double takes.
  constexpr int kMaxSteps = 40;
  // Of a column of random entries an eigenvector v has a share of about |A v| |v| / |v^T A v| over
  // the root of the rows, and that ratio is no less than 1. One that does not contract keeps its
  // share, which is below a tenth of that in all eight columns once in a billion.
  const double contracted = 0.1 / std::sqrt(static_cast<double>(size_of(matrix)));
  Eigen::MatrixXd errors = random_block(matrix, kColumns, kSeed);
  const Eigen::VectorXd squares = column_products(ranks, errors, errors);
  double before = 1;
  for (int step = 0; step < kMaxSteps; ++step) {
    errors -= with_unit_columns(ranks, block_product(matrix, errors), inverse);
    const Eigen::ArrayXd shares =
        (column_products(ranks, errors, errors).array() / squares.array()).sqrt();
    if (!shares.isFinite().all()) return false;
    const double left = shares.maxCoeff();
    if (left < contracted) return true;
    const bool is_in_reach = left * std::pow(left / before, kMaxSteps - step) < contracted;
    if (!is_in_reach) return false;
    before = left;
  }
  return false;
}

std::optional<Eigen::Index> count_without_pivoting(Mat matrix, Mat product, CholmodOrder kind,
                                                   std::span<const std::int32_t> node_order,
                                                   unsigned threads) {
  const cholmod_sparse view = cholmod_view(matrix);
  CholmodAnalysis analysis(view, kind, node_order);
  const auto require_memory_for = [&](double bytes_per_entry) {
    require_memory("counting modes by inertia", bytes_per_entry * analysis.nonzeros(),
                   "take a coarser mesh, or leave out modes.certify");
  };
  require_memory_for(kBytesPerSingleEntry);
  if (const auto counted = count_by_factor<float>(analysis, product, threads)) return counted;
  require_memory_for(kBytesPerFactorEntry);
  return count_by_factor<double>(analysis, product, threads);
}

}  // namespace flexneck::fe_modal
