// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/cholesky_factor.h"

#include <array>
#include <cstdio>
#include <vector>

#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/cholmod_handles.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

std::string millions_text(double entries) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.4g million entries", entries / 1e6);
  return text.data();
}

}  // namespace

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift, CholmodOrder kind,
                               std::span<const std::int32_t> node_order, unsigned threads)
    : ShiftInverse(shift), threads_(threads) {
  const cholmod_sparse view = cholmod_view(shifted_stiffness);
  CholmodAnalysis analysis(view, kind, node_order);
  nonzeros_ = analysis.nonzeros();
  require_memory("the factor of " + millions_text(nonzeros_), kBytesPerFactorEntry * nonzeros_,
                 kOrAnotherSolution);
  factor_ = SupernodalFactor<double>(analysis, threads_in_blas(threads));
}

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift,
                               std::span<const std::int32_t> node_order, unsigned threads)
    : CholeskyFactor(shifted_stiffness, shift,
                     node_order.empty() ? CholmodOrder::best : CholmodOrder::given, node_order,
                     threads) {}

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift, AsNumbered, unsigned threads)
    : CholeskyFactor(shifted_stiffness, shift, CholmodOrder::numbering, {}, threads) {}

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::MatrixXd& right_hand_sides) const {
  Eigen::MatrixXd x = right_hand_sides(factor_.order(), Eigen::all);
  factor_.solve(x, threads_);
  Eigen::MatrixXd solutions(x.rows(), x.cols());
  solutions(factor_.order(), Eigen::all) = x;
  return solutions;
}

bool CholeskyFactor::is_doubtful() const { return factor_.smallest_pivot() < kSingularPivot; }

std::string CholeskyFactor::describe() const {
  return "the factor has " + millions_text(nonzeros_);
}

}  // namespace flexneck::fe_modal
