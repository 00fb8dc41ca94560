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

void SubdomainFactor::add_solution(const Eigen::MatrixXf& residuals,
                                   const std::vector<std::int32_t>& nodes,
                                   Eigen::MatrixXf& result) const {
  std::vector<Eigen::Index> rows;  // of the whole, in the order of elimination
  rows.reserve(supernodes_.order().size());
  for (const int dof : supernodes_.order()) {
    rows.push_back(3 * nodes[static_cast<std::size_t>(dof / 3)] + dof % 3);
  }
  Eigen::MatrixXf x = residuals(rows, Eigen::all);
  supernodes_.solve(values_, x);
  result(rows, Eigen::all) += x;
}

}  // namespace flexneck::fe_modal
