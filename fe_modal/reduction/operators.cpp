// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/reduction/operators.h"

namespace flexneck::fe_modal {

BodyOperators operators_of(const ModalSystem& system, const LinearSolver& inverse) {
  const auto multiply_by = [](Mat matrix) {
    return [matrix](const Eigen::MatrixXd& in) { return block_product(matrix, in); };
  };
  return {multiply_by(system.stiffness()), multiply_by(system.mass()),
          [&inverse](const Eigen::MatrixXd& loads) { return inverse.solve(loads); },
          inverse.shift(), inverse.ranks()};
}

}  // namespace flexneck::fe_modal
