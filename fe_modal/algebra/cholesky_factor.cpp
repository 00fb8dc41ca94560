// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/algebra/cholesky_factor.h"

#include <array>
#include <cstdio>
#include <vector>

#include "fe_modal/algebra/blas_kernels.h"
#include "fe_modal/algebra/block_product.h"
#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/algebra/random_block.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Rounding errors of 1e-16 can leave a positive pivot of a singular matrix; those of sound ones
/// are hardly so small, of their entry on the diagonal.
constexpr double kDoubtfulPivot = 1e-10;
/// Of a solution, what rounding errors may change.
constexpr double kLostDigits = 1e-3;

std::string millions_text(double entries) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%.4g million entries", entries / 1e6);
  return text.data();
}

}  // namespace

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift, CholmodOrder kind,
                               std::span<const int> dof_order, unsigned threads)
    : ShiftInverse(shift), threads_(threads) {
  const cholmod_sparse view = cholmod_view(shifted_stiffness);
  CholmodAnalysis analysis(view, kind, dof_order);
  nonzeros_ = analysis.nonzeros();
  require_memory("the factor of " + millions_text(nonzeros_), kBytesPerFactorEntry * nonzeros_,
                 kOrAnotherSolution);
  factor_ = SupernodalFactor<double>(analysis, threads_in_blas(threads));
  if (factor_.smallest_pivot() < kDoubtfulPivot && !solves(shifted_stiffness)) {
    throw ComputationError(kNotDefinite);
  }
}

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift,
                               std::span<const std::int32_t> node_order, unsigned threads)
    : CholeskyFactor(shifted_stiffness, shift,
                     node_order.empty() ? CholmodOrder::best : CholmodOrder::given,
                     order_of_dofs(node_order), threads) {}

CholeskyFactor::CholeskyFactor(Mat shifted_stiffness, double shift, AsNumbered, unsigned threads)
    : CholeskyFactor(shifted_stiffness, shift, CholmodOrder::numbering, {}, threads) {}

bool CholeskyFactor::solves(Mat matrix) const {
  constexpr std::uint64_t kSeed = 1;
  const Eigen::MatrixXd truth = random_block(matrix, 1, kSeed);
  const Eigen::MatrixXd found = solve(block_product(matrix, truth));
  return (found - truth).norm() < kLostDigits * truth.norm();
}

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::MatrixXd& right_hand_sides) const {
  Eigen::MatrixXd x = right_hand_sides(factor_.order(), Eigen::all);
  factor_.solve(x, threads_);
  Eigen::MatrixXd solutions(x.rows(), x.cols());
  solutions(factor_.order(), Eigen::all) = x;
  return solutions;
}

std::string CholeskyFactor::describe() const {
  return "the factor has " + millions_text(nonzeros_);
}

}  // namespace flexneck::fe_modal
