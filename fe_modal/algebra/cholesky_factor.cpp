// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/cholesky_factor.h"

#include <vector>

#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/cholmod_handles.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::fe_modal {
namespace {

std::string millions_text(double entries) {
  return rounded_text(entries / 1e6, 4) + " million entries";
}

}  // namespace

std::string entries_text(double nonzeros) { return "the factor has " + millions_text(nonzeros); }

void require_memory_for_factor(double nonzeros, double bytes_per_entry) {
  require_memory("the factor of " + millions_text(nonzeros), bytes_per_entry * nonzeros,
                 kOrAnotherSolution);
}

CholeskyFactor::CholeskyFactor(CholmodAnalysis& analysis, double shift, unsigned threads)
    : ShiftInverse(shift), threads_(threads) {
  factorise(analysis);
}

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift, CholmodOrder kind,
                               std::span<const std::int32_t> node_order, unsigned threads)
    : ShiftInverse(shift), threads_(threads) {
  const cholmod_sparse view = cholmod_view(shifted_stiffness);
  CholmodAnalysis analysis(view, kind, node_order);
  factorise(analysis);
}

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift,
                               std::span<const std::int32_t> node_order, unsigned threads)
    : CholeskyFactor(shifted_stiffness, shift,
                     node_order.empty() ? CholmodOrder::best : CholmodOrder::given, node_order,
                     threads) {}

void CholeskyFactor::factorise(CholmodAnalysis& analysis) {
  nonzeros_ = analysis.nonzeros();
  require_memory_for_factor(nonzeros_, kBytesPerFactorEntry);
  factor_ = SupernodalFactor<double>(analysis, threads_in_blas(threads_));
}

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::MatrixXd& right_hand_sides) const {
  return factor_.solution(right_hand_sides, threads_);
}

bool CholeskyFactor::is_doubtful() const { return factor_.smallest_pivot() < kSingularPivot; }

std::string CholeskyFactor::describe() const { return entries_text(nonzeros_); }

}  // namespace flexneck::fe_modal
