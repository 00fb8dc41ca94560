// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/subdomain_factor.h"

#include <utility>

#include "fe_modal/algebra/cholmod_handles.h"
#include "fe_modal/solve/iterative/single_inverse.h"

namespace flexneck::fe_modal {
SubdomainFactor::SubdomainFactor(const SymmetricMatrix& matrix,
                                 std::span<const std::int32_t> node_order, unsigned threads) {
  const cholmod_sparse view = cholmod_view(matrix.offsets(), matrix.columns(), matrix.values());
  CholmodAnalysis analysis(view, CholmodOrder::given, node_order);
  auto factor = factorise_in_single(analysis, threads);
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
