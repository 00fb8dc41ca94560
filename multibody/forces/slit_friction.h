// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::multibody {

/// Coulomb friction between the sides of a section's one slit. The section's last coordinates s, m,
/// are ways in which the sides slide. The energy pulls at them by F = -dV/ds, and the slit's shut
/// gaps press with the sum N of their forces. The sides stick where |F| <= mu N, and else slide
/// along F, against mu N:
///   s' = (|F| - mu N) / c  F / |F|,   c = sliding time * mean stiffness of s.
/// F s' is never below zero, so that sliding only takes energy. An open slit has N = 0, and slides
/// within the sliding time to where no load is on s.
struct SlitFriction {
  Eigen::Index slides = 0;  ///< how many s; 0: none of this
  double coefficient = 0;   ///< mu
  double sliding_time_s = 0;
};

}  // namespace flexneck::multibody
