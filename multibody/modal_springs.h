// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "multibody/model.h"

namespace flexneck::multibody {

/// What draws the m modal coordinates of a body back, equations.md section 3: mode l feels
/// -stiffness_l (a_l - offset_l) - damping_l a_l'. A rigid body has none.
struct ModalSprings {
  ModalSprings() = default;
  explicit ModalSprings(const DeformableBody& body);

  /// Against growing a_l.
  double load(Eigen::Index l, double a, double a_rate) const {
    return stiffness[l] * (a - offset[l]) + damping[l] * a_rate;
  }
  template <typename Modal>
  double energy_J(const Modal& a) const {
    double energy = 0;
    for (Eigen::Index l = 0; l < stiffness.size(); ++l) {
      const double stretch = a[l] - offset[l];
      energy += 0.5 * stiffness[l] * stretch * stretch;
    }
    return energy;
  }
  template <typename Modal>
  double lost_W(const Modal& a_rate) const {
    double power = 0;
    for (Eigen::Index l = 0; l < damping.size(); ++l) power += damping[l] * a_rate[l] * a_rate[l];
    return power;
  }

  Eigen::VectorXd stiffness;  ///< omega^2, 1/s^2
  Eigen::VectorXd damping;    ///< 2 zeta omega, 1/s
  Eigen::VectorXd offset;     ///< coordinates without load
};

}  // namespace flexneck::multibody
