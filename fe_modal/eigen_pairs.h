// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// The lowest eigenpairs of K x = lambda M x.
struct EigenPairs {
  Eigen::VectorXd values;   ///< (m), ascending, 1/s^2
  Eigen::MatrixXd vectors;  ///< (dofs, m), x^T M x = 1
};

}  // namespace flexneck::fe_modal
