// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace flexneck::multibody {

/// Slits of a deformable body that open and close. Their openings g >= 0, m, have no mass: with the
/// modal coordinates a relative to rest the body's energy is that of its modes, slits closed, plus
/// the minimum of g^T K_g g / 2 + g^T C a over g. Its loads are continuous, and opening and closing
/// creates no energy.
struct SlitGaps {
  Eigen::MatrixXd stiffness;  ///< K_g, (g, g), N/m; empty: no slits
  Eigen::MatrixXd coupling;   ///< C, (g, m), N / (kg^(1/2) m)

  Eigen::Index count() const { return stiffness.rows(); }
  /// The openings for the coordinates, (g).
  Eigen::VectorXd openings_m(const Eigen::VectorXd& from_rest) const;
};

/// Minimises g^T A g / 2 + r^T g over g >= 0, A positive definite, by pivots on the lowest index
/// that violates (Murty, Linear Algebra Appl. 5 (1972) 65), which terminates for any such A.
/// @throws ComputationError if rounding prevents termination.
Eigen::VectorXd least_openings(const Eigen::MatrixXd& A, const Eigen::VectorXd& r);

}  // namespace flexneck::multibody
