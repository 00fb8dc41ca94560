// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <utility>

#include <Eigen/Core>

#include "fe_modal/body/modal_body.h"

namespace flexneck::testing {

/// Roots of cos x cosh x = -1.
inline constexpr std::array<double, 4> kClampedFree = {1.8751040687119611, 4.6940911329741745,
                                                       7.8547574382376126, 10.995540734875467};

/// Clamped-free shape with unit mean square, and its slope times the length, at z / length;
/// positive at the free end, where it is 2.
std::pair<double, double> clamped_free_shape(std::size_t n, double z);

/// Gauss-Legendre rule on [0, 1] by Golub and Welsch.
std::pair<Eigen::VectorXd, Eigen::VectorXd> gauss_rule(Eigen::Index count);

/// An Euler-Bernoulli beam along z, clamped at the origin, free at the top: a modal body in closed
/// form, independent of the finite elements. Its cross sections translate without rotary inertia,
/// so the textbook shapes are exactly orthogonal.
struct Beam {
  double length_m = 0.1438;
  double mass_kg = 1.21;
  double gyration_m = 0.028;  ///< gyration radius of a cross section, about x and about y
  double fore_aft_Hz = 36.1;  ///< first bending mode along x
  double lateral_Hz = 36.3;   ///< first bending mode along y
  int fore_aft_modes = 2;     ///< at most 4
  int lateral_modes = 2;      ///< at most 4
  double twist_Hz = 57.2;     ///< first clamped-free torsion mode
  int twist_modes = 0;
};

/// Makes the modal body with interfaces "base" at the origin, which no mode moves, and "top" at the
/// free end. The invariants are integrals by 40 Gauss points along the beam, exact to rounding,
/// with four points per section.
fe_modal::ModalBody make_beam_body(const Beam& beam);

}  // namespace flexneck::testing
