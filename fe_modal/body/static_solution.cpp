// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/body/static_solution.h"

#include <Eigen/Geometry>

namespace flexneck::fe_modal {

Resultant resultant_of(const Eigen::Matrix3Xd& nodes_m, const Eigen::Matrix3Xd& forces_N) {
  Resultant sum{forces_N.rowwise().sum(), Eigen::Vector3d::Zero()};
  for (Eigen::Index k = 0; k < nodes_m.cols(); ++k) {
    sum.moment_Nm += Eigen::Vector3d(nodes_m.col(k)).cross(Eigen::Vector3d(forces_N.col(k)));
  }
  return sum;
}

}  // namespace flexneck::fe_modal
