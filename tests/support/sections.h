// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/model/model.h"
#include "tests/support/point_mass_body.h"

namespace flexneck::testing {

/// A random symmetric positive definite matrix, for sections.
inline Eigen::Matrix<double, 6, 6> random_stiffness(RandomNumbers& random) {
  Eigen::Matrix<double, 6, 6> root;
  random.fill(root);
  return 50 * (root * root.transpose() + 0.1 * Eigen::Matrix<double, 6, 6>::Identity());
}

inline multibody::RigidBody ball(double mass_kg, double inertia_kg_m2) {
  return {mass_kg, Eigen::Vector3d::Zero(), inertia_kg_m2 * Eigen::Matrix3d::Identity()};
}

}  // namespace flexneck::testing
