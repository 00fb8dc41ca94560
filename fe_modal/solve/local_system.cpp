// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/solve/local_system.h"

#include "fe_modal/algebra/cholesky_factor.h"
#include "fe_modal/solve/sturm_count.h"
#include "mesher/partition/node_order.h"

namespace flexneck::fe_modal {

LocalSystem::LocalSystem(SystemMatrices matrices, std::vector<std::int32_t> node_order)
    : matrices_(std::move(matrices)),
      node_order_(std::move(node_order)),
      stiffness_(matrices_.stiffness.size(), [this](const Eigen::MatrixXd& columns) {
        return block_product(matrices_.stiffness, columns);
      }) {}

std::unique_ptr<ShiftInverse> LocalSystem::shift_inverse(double shift) const {
  const std::vector<std::int32_t> order =
      node_order_.empty()
          ? mesher::nested_dissection(matrices_.graph.offsets(), matrices_.graph.columns())
          : node_order_;
  if (shift == 0) {
    return std::make_unique<CholeskyFactor>(matrices_.stiffness.get(), shift, order);
  }
  return std::make_unique<CholeskyFactor>(shifted_stiffness(matrices_, shift).get(), shift, order);
}

Eigen::Index LocalSystem::eigenvalues_below(double sigma) const {
  return fe_modal::eigenvalues_below(matrices_, sigma);
}

}  // namespace flexneck::fe_modal
