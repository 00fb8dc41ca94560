// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/inertia_count.h"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

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

/// Scaled to a diagonal of ones and minus ones, V^T A V and V^T M B^-1 M V have such eigenvalues
/// where V are modes. Signs of smaller ones than this are not trusted: far above rounding in single
/// precision (inferred).
constexpr double kUncertain = 1e-2;
/// Q on the scale of V^T A V: a hundredth of what signs are told by (inferred).
constexpr double kUncoupled = 1e-4;

/// With a diagonal of ones and minus ones.
Eigen::MatrixXd scaled(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& diagonal) {
  const Eigen::VectorXd scale = diagonal.cwiseAbs().cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * matrix * scale.asDiagonal();
}

/// Nothing if a sign is uncertain.
std::optional<Eigen::Index> count_negative(const Eigen::MatrixXd& matrix) {
  if (matrix.size() == 0) return 0;
  const Eigen::MatrixXd unit = scaled(matrix, matrix.diagonal());
  if (!unit.allFinite()) return std::nullopt;
  const Eigen::ArrayXd values = unit.selfadjointView<Eigen::Lower>().eigenvalues();
  if (values.abs().minCoeff() < kUncertain) return std::nullopt;
  return (values < 0).count();
}

/// W B_W^-1 W^T = B^-1 - B^-1 M V (V^T M B^-1 M V)^-1 V^T M B^-1
class ProjectedInverse {
 public:
  ProjectedInverse(const Ranks& ranks, const BlockOperator& inverse, const KnownVectors& known)
      : ranks_(ranks), inverse_(inverse), mass_products_(known.mass_products) {
    if (mass_products_.cols() == 0) return;
    responses_ = with_unit_columns(ranks_, mass_products_, inverse_);
    projected_ = inner_products(ranks_, mass_products_, responses_);
    solver_.compute(projected_);
  }

  /// V^T M B^-1 M V, symmetric but for rounding in single precision.
  const Eigen::MatrixXd& projected() const { return projected_; }

  Eigen::MatrixXd operator()(const Eigen::MatrixXd& columns) const {
    return projection(with_unit_columns(ranks_, columns, inverse_));
  }

  /// x - B^-1 M V (V^T M B^-1 M V)^-1 V^T M x: of the vectors w with V^T M w = 0.
  Eigen::MatrixXd projection(Eigen::MatrixXd columns) const {
    if (responses_.cols() == 0) return columns;
    columns -= responses_ * solver_.solve(inner_products(ranks_, mass_products_, columns));
    return columns;
  }

 private:
  const Ranks& ranks_;
  const BlockOperator& inverse_;
  const Eigen::MatrixXd& mass_products_;
  Eigen::MatrixXd responses_;  ///< B^-1 M V
  Eigen::MatrixXd projected_;
  Eigen::PartialPivLU<Eigen::MatrixXd> solver_;
};

/// neg(V^T A V - Q), where Q must be too small to change a sign. Q has A_W^-1, which is not at
/// hand; it is estimated with B_W^-1: where I - B_W^-1 A_W contracts as contracts() asks, A_W^-1
/// makes less than ten times as much of it.
std::optional<Eigen::Index> count_among(const Ranks& ranks, Mat matrix, const KnownVectors& known,
                                        const ProjectedInverse& inverse) {
  const Eigen::MatrixXd& v = known.vectors;
  if (v.cols() == 0) return 0;
  const Eigen::MatrixXd forces = block_product(matrix, v);
  const Eigen::MatrixXd projected = inner_products(ranks, v, forces);
  // What is left of A V without its shares of M V, which the projection would take from it.
  const Eigen::MatrixXd residuals = forces - known.mass_products * projected;
  const Eigen::MatrixXd coupling = inner_products(ranks, residuals, inverse(residuals));
  const bool is_small = scaled(coupling, projected.diagonal()).norm() < kUncoupled;
  return is_small ? count_negative(projected) : std::nullopt;
}

/// Whether I - B_W^-1 A_W contracts.
bool contracts(const Ranks& ranks, Mat matrix, const ProjectedInverse& inverse) {
  constexpr Eigen::Index kColumns = 8;  // which a factor takes together
  constexpr std::uint64_t kSeed = 20240611;
  // Calibrated: with 200 000 rows as long as half a factor in double takes.
  constexpr int kMaxSteps = 40;
  // Of a column of random entries an eigenvector v has a share of about |A v| |v| / |v^T A v| over
  // the root of the rows, and that ratio is no less than 1. One that does not contract keeps its
  // share, which is below a tenth of that in all eight columns once in a billion.
  const double contracted = 0.1 / std::sqrt(static_cast<double>(size_of(matrix)));
  const Eigen::MatrixXd start = random_block(matrix, kColumns, kSeed);
  const Eigen::VectorXd squares = column_products(ranks, start, start);
  Eigen::MatrixXd errors = inverse.projection(start);
  double before = 1;
  for (int step = 0; step < kMaxSteps; ++step) {
    errors -= inverse(block_product(matrix, errors));
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

template <typename Scalar>
std::optional<Eigen::Index> count_in(CholmodAnalysis& analysis, Mat product,
                                     const KnownVectors& known, unsigned threads) {
  try {
    const SupernodalFactor<Scalar> factor(analysis, threads_in_blas(threads), {},
                                          Pivots::of_any_sign);
    const auto inverse = [&](const Eigen::MatrixXd& x) { return factor.solution(x, threads); };
    return count_by_factor({}, product, {inverse, factor.negative_pivots()}, known);
  } catch (const OutOfMemory&) {
    throw;
  } catch (const ComputationError&) {  // a pivot is zero
    return std::nullopt;
  }
}

}  // namespace

std::optional<Eigen::Index> count_by_factor(const Ranks& ranks, Mat matrix,
                                            const SignedFactor& factor, const KnownVectors& known) {
  const ProjectedInverse inverse(ranks, factor.inverse, known);
  const std::optional<Eigen::Index> of_inverse = count_negative(inverse.projected());
  if (!of_inverse || !contracts(ranks, matrix, inverse)) return std::nullopt;
  const std::optional<Eigen::Index> among = count_among(ranks, matrix, known, inverse);
  if (!among) return std::nullopt;
  return factor.negative_pivots - *of_inverse + *among;
}

std::optional<Eigen::Index> count_without_pivoting(Mat matrix, Mat product, CholmodOrder kind,
                                                   std::span<const std::int32_t> node_order,
                                                   const KnownVectors& known, unsigned threads) {
  const cholmod_sparse view = cholmod_view(matrix);
  CholmodAnalysis analysis(view, kind, node_order);
  const auto require_memory_for = [&](double bytes_per_entry) {
    require_memory("counting modes by inertia", bytes_per_entry * analysis.nonzeros(),
                   "take a coarser mesh, or leave out modes.certify");
  };
  require_memory_for(kBytesPerSingleEntry);
  if (const auto counted = count_in<float>(analysis, product, known, threads)) return counted;
  require_memory_for(kBytesPerFactorEntry);
  return count_in<double>(analysis, product, known, threads);
}

}  // namespace flexneck::fe_modal
