// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/iterative/subdomain_factor.h"

#include <algorithm>

#include "fe_modal/algebra/cholmod_handles.h"

namespace flexneck::fe_modal {

SubdomainFactor::SubdomainFactor(const SymmetricMatrix& matrix,
                                 std::span<const std::int32_t> node_order) {
  CholmodSession session(CholmodOrder::given);
  const cholmod_sparse view = cholmod_view(matrix.offsets(), matrix.columns(), matrix.values());
  CholmodFactor factor = analyse(view, order_of_dofs(node_order), session);
  factorise(view, factor, session);
  supernodes_ = Supernodes(*factor);
  const std::span<const double> values = values_of(*factor);
  values_.resize(values.size());
  std::transform(values.begin(), values.end(), values_.begin(),
                 [](double value) { return static_cast<float>(value); });
}

std::vector<Eigen::Index> SubdomainFactor::rows_of(const std::vector<std::int32_t>& nodes) const {
  std::vector<Eigen::Index> rows;
  rows.reserve(supernodes_.order().size());
  for (const int dof : supernodes_.order()) {
    rows.push_back(3 * nodes[static_cast<std::size_t>(dof / 3)] + dof % 3);
  }
  return rows;
}

Eigen::MatrixXf SubdomainFactor::solve(Eigen::MatrixXf right_hand_sides) const {
  constexpr unsigned kAlone = 1;  // each subdomain has a thread
  supernodes_.solve(values_, right_hand_sides, kAlone);
  return right_hand_sides;
}

}  // namespace flexneck::fe_modal
