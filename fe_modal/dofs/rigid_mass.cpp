// SPDX-License-Identifier: GPL-3.0-or-later
#include "fe_modal/dofs/rigid_mass.h"

#include "fe_modal/body/skew.h"

namespace flexneck::fe_modal {

Eigen::Matrix<double, 6, 6> rigid_mass_matrix(double mass_kg, const Eigen::Vector3d& center_m,
                                              const Eigen::Matrix3d& inertia_kg_m2) {
  const Eigen::Matrix3d crossed = skew(center_m);
  Eigen::Matrix<double, 6, 6> matrix;
  matrix << mass_kg * Eigen::Matrix3d::Identity(), -mass_kg * crossed, mass_kg * crossed,
      inertia_kg_m2 - mass_kg * crossed * crossed;
  return matrix;
}

Eigen::Matrix3d inertia_of(const mesher::PointMass& mass) {
  const auto& i = mass.inertia_kg_m2;
  Eigen::Matrix3d tensor;
  tensor << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
  return tensor;
}

Eigen::Matrix<double, 6, 6> mass_matrix_of(const mesher::PointMass& mass) {
  return rigid_mass_matrix(mass.mass_kg, Eigen::Vector3d(mass.center_m.data()), inertia_of(mass));
}

}  // namespace flexneck::fe_modal
