// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/model/modal_springs.h"

#include <numbers>

#include "multibody/model/stress_stiffening.h"

namespace flexneck::multibody {

ModalSprings::ModalSprings(const DeformableBody& body)
    : offset(body.offset), curvatures(modal_curvatures(body)), gaps(body.gaps) {
  const Eigen::VectorXd omega = 2 * std::numbers::pi * body.modes.frequencies_Hz;
  stiffness = omega.cwiseAbs2();
  damping = 2 * body.damping_ratio.cwiseProduct(omega);
  if (offset.size() == 0) offset.setZero(omega.size());
}

}  // namespace flexneck::multibody
