// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <string>

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// The lowest eigenpairs of K x = lambda M x.
struct EigenPairs {
  Eigen::VectorXd values;   ///< (m), ascending, 1/s^2
  Eigen::MatrixXd vectors;  ///< (dofs, m), x^T M x = 1
  /// The eigenvalue above the last, to lower accuracy; infinite if there is none or it is not
  /// known.
  double next = std::numeric_limits<double>::infinity();
  std::string search = {};  ///< SLEPc's account of the search
};

}  // namespace flexneck::fe_modal
