// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/single_inverse.h"

#include <utility>

#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/algebra/matrix_product.h"
#include "fe_modal/solve/block_lanczos.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {

std::optional<SupernodalFactor<float>> factorise_in_single(CholmodAnalysis& analysis,
                                                           unsigned threads) {
  try {
    SupernodalFactor<float> factor(analysis, threads);
    if (factor.smallest_pivot() > kDoubtfulSinglePivot) return factor;
  } catch (const OutOfMemory&) {
    throw;
  } catch (const ComputationError&) {  // perhaps definite all the same, but for seven digits
  }
  return std::nullopt;
}

SingleInverse::SingleInverse(SingleFactor factor, const Matrices& matrices, double shift,
                             InDouble make_in_double, const Ranks& ranks)
    : PreconditionedInverse(matrices.stiffness, matrices.mass, shift, ranks),
      factor_(std::move(factor)),
      make_in_double_(std::move(make_in_double)) {}

void SingleInverse::go_on_in_double() const {
  factor_.apply = {};  // before the other takes memory
  in_double_ = make_in_double_();
}

Eigen::MatrixXd SingleInverse::apply(const Eigen::MatrixXd& residuals) const {
  if (in_double_) return in_double_->solve(residuals);
  return with_unit_columns(ranks(), residuals, factor_.apply);
}

Eigen::MatrixXd SingleInverse::solve(const Eigen::MatrixXd& right_hand_sides) const {
  constexpr int kMaxIterations = 50;  // of sound bodies 3 to 6
  if (!in_double_) {
    try {
      return gradient_solution(right_hand_sides, kMaxIterations);
    } catch (const OutOfMemory&) {
      throw;
    } catch (const ComputationError&) {  // on all ranks
      go_on_in_double();
    }
  }
  return in_double_->solve(right_hand_sides);
}

Eigen::MatrixXd SingleInverse::improve(const Eigen::MatrixXd& right_hand_sides,
                                       const Eigen::MatrixXd& solutions) const {
  if (in_double_) return in_double_->solve(right_hand_sides);
  return solutions + apply(right_hand_sides - multiply(solutions));
}

std::optional<EigenPairs> SingleInverse::iterate(Mat mass, Eigen::Index count) const {
  if (in_double_) return std::nullopt;
  // Shapes as exact as those by a factor in double (calibrated): an iteration more than 1e-15
  // takes.
  constexpr double kTolerance = 1e-18;
  // Ten modes of necks take 7 to 9. What rounding hides, eigenvalues far below those of most
  // bodies, never settles.
  constexpr int kMaxIterations = 20;
  const auto pairs = davidson_pairs(mass, count, {kTolerance, kMaxIterations});
  // In single precision a matrix that is hardly indefinite may have a factor; one in double tells.
  const bool is_definite = pairs && pairs->values.minCoeff() > shift();
  if (is_definite) return purified(mass, *this, *pairs);
  go_on_in_double();
  return std::nullopt;
}

bool SingleInverse::is_doubtful() const { return in_double_ && in_double_->is_doubtful(); }

std::string SingleInverse::describe() const {
  if (in_double_) return in_double_->describe();
  return factor_.text + ", 4 bytes each" + iterations_text();
}

std::unique_ptr<ShiftInverse> make_shift_inverse(Mat shifted_stiffness, const Matrices& matrices,
                                                 double shift, CholmodOrder kind,
                                                 std::span<const std::int32_t> node_order,
                                                 unsigned threads,
                                                 SingleInverse::InDouble make_in_double) {
  const cholmod_sparse view = cholmod_view(shifted_stiffness);
  CholmodAnalysis analysis(view, kind, node_order);
  require_memory_for_factor(analysis.nonzeros(), kBytesPerSingleEntry);
  auto single = factorise_in_single(analysis, threads_in_blas(threads));
  if (!single) return std::make_unique<CholeskyFactor>(analysis, shift, threads);
  const auto factor = std::make_shared<const SupernodalFactor<float>>(std::move(*single));
  return std::make_unique<SingleInverse>(SingleFactor{[factor, threads](const Eigen::MatrixXd& x) {
                                                        return factor->solution(x, threads);
                                                      },
                                                      entries_text(analysis.nonzeros())},
                                         matrices, shift, std::move(make_in_double));
}

}  // namespace flexneck::fe_modal
