// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <Eigen/Core>

#include "multibody/simulation.h"

namespace flexneck::multibody {

/// Modes of xi'' + damping xi' + stiffness xi = 0, ascending in frequency: from each conjugate pair
/// of eigenvalues lambda, f = |lambda| / 2 pi and zeta = -Re lambda / |lambda|. Real eigenvalues,
/// those of overdamped motion, are paired by their shapes: with l1 and l2 those of a pair,
/// (2 pi f)^2 = l1 l2 and zeta = -(l1 + l2) / (2 sqrt(l1 l2)) >= 1, damped frequency zero. A motion
/// without restoring force has frequency and damping ratio zero.
/// @throws ComputationError if a motion grows instead of swinging: there is no stable equilibrium.
std::vector<SystemMode> modes_of(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& damping);

}  // namespace flexneck::multibody
