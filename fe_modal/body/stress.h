// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Core>

namespace flexneck::fe_modal {

/// Components of a symmetric stress tensor in the order xx, yy, zz, xy, xz, yz, in Pa, tension
/// positive.
using Stress = Eigen::Matrix<double, 6, 1>;
using Stresses = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// The two axes of each component.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kStressAxes = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

inline Eigen::Matrix3d tensor_of(const Stress& stress) {
  Eigen::Matrix3d tensor;
  for (std::size_t c = 0; c < kStressAxes.size(); ++c) {
    const auto k = static_cast<Eigen::Index>(kStressAxes[c][0]);
    const auto l = static_cast<Eigen::Index>(kStressAxes[c][1]);
    tensor(k, l) = tensor(l, k) = stress[static_cast<Eigen::Index>(c)];
  }
  return tensor;
}

/// Von Mises stress sqrt(3/2 dev:dev), Pa.
inline double von_mises_Pa(const Stress& stress) {
  const Eigen::Vector3d normal = stress.head<3>().array() - stress.head<3>().mean();
  return std::sqrt(1.5 * (normal.squaredNorm() + 2 * stress.tail<3>().squaredNorm()));
}

}  // namespace flexneck::fe_modal
