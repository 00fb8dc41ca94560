// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::multibody {

/// Coulomb friction between the sides of a section's only slit. The section's last coordinates s,
/// m, are sliding displacements of the sides. The energy pulls at them by F = -dV/ds, and the
/// slit's closed gaps press with the sum N of their forces. The sides stick where |F| <= mu N, and
/// otherwise slide along F, against mu N:
///   s' = (|F| - mu N) / c  F / |F|,   c = sliding time * mean stiffness of s.
/// F s' is never negative, so that sliding only dissipates energy. An open slit has N = 0, and
/// slides within the sliding time to where no load acts on s.
struct SlitFriction {
  Eigen::Index slides = 0;  ///< number of s; 0: no friction
  double coefficient = 0;   ///< mu
  double sliding_time_s = 0;
};

}  // namespace flexneck::multibody
