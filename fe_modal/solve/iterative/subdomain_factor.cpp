// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/subdomain_factor.h"

#include <optional>
#include <utility>

#include "fe_modal/algebra/cholmod_handles.h"
#include "geometry/foundation/error.h"

namespace flexneck::fe_modal {
namespace {

/// Of an entry on the diagonal: where elimination leaves less, rounding errors of 6e-8 may make
/// much of the pivot.
constexpr double kDoubtfulPivot = 1e-5;

std::optional<SupernodalFactor<float>> factor_in_single_precision(CholmodAnalysis& analysis,
                                                                  unsigned threads) {
  try {
    SupernodalFactor<float> factor(analysis, threads);
    if (factor.smallest_pivot() > kDoubtfulPivot) return factor;
  } catch (const ComputationError&) {  // perhaps definite all the same, but for seven digits
  }
  return std::nullopt;
}

}  // namespace

SubdomainFactor::SubdomainFactor(const SymmetricMatrix& matrix,
                                 std::span<const std::int32_t> node_order, unsigned threads) {
  const cholmod_sparse view = cholmod_view(matrix.offsets(), matrix.columns(), matrix.values());
  CholmodAnalysis analysis(view, CholmodOrder::given, node_order);
  auto factor = factor_in_single_precision(analysis, threads);
  factor_ = factor ? std::move(*factor)
                   : SupernodalFactor<float>(SupernodalFactor<double>(analysis, threads));
}

std::vector<Eigen::Index> SubdomainFactor::rows_of(const std::vector<std::int32_t>& nodes) const {
  std::vector<Eigen::Index> rows;
  rows.reserve(factor_.order().size());
  for (const int dof : factor_.order()) {
    rows.push_back(3 * nodes[static_cast<std::size_t>(dof / 3)] + dof % 3);
  }
  return rows;
}

Eigen::MatrixXf SubdomainFactor::solve(Eigen::MatrixXf right_hand_sides) const {
  constexpr unsigned kAlone = 1;  // each subdomain has a thread
  factor_.solve(right_hand_sides, kAlone);
  return right_hand_sides;
}

}  // namespace flexneck::fe_modal
