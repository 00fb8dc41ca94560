// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>

#include "multibody/forces/force_element.h"
#include "multibody/forces/load_curve.h"

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

/// A slender elastic part between two bodies, such as the rubber between two plates, with a
/// stiffness for small motions, formulated co-rotationally. Its strain e = [w + theta x r / 2;
/// theta] holds the rotation vector theta of marker j relative to i and
///   w = R_mid^T (p_j - p_i) - sinc(theta_b / 2) r,   R_mid = R_i exp(~theta / 2),
/// with r the rest length and direction and theta_b the part of theta transverse to it: bending to
/// an arc of the same length does not stretch. For small motions e is the displacement of j, in i's
/// axes.
///
/// Slits add gaps g >= 0 (openings without friction): the energy is the minimum of [e; g]^T K [e;
/// g] / 2 over them, so that loads follow from it exactly, whatever the rotation (below pi), and
/// closing and opening creates no energy. With friction the sides of one slit slide by coordinates
/// of their own, which follow the gaps (SlitFriction). Maxwell branches add stiffness that relaxes:
/// sum s^T K_b s / 2, s the strain of the branch's spring (MaxwellBranch).
///
/// A bending curve, moment over angle from a nonlinear solution, scales the transverse part of
/// theta, so that the moment is the curve's times the stiffness over its first slope.
struct Section {
  static constexpr std::string_view kName = "section";
  static constexpr bool kHolds = true;
  static constexpr bool kHasKinks = true;  ///< where a gap opens or closes
  static constexpr std::string_view kKink =
      "a gap opens or closes, its sides stick or slip, or a row of its bending curve";

  static constexpr int kMaxGaps = 4;
  static constexpr int kMaxGapsOfSlit = 2;  ///< with friction
  static constexpr int kMaxSlides = 8;
  static constexpr int kMaxSize = 6 + std::max(kMaxGaps, kMaxGapsOfSlit + kMaxSlides);
  using Strain = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxSize, 1>;
  using Stiffness = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxSize, kMaxSize>;
  using Branch = MaxwellBranch<Stiffness>;

  std::string name;
  std::size_t marker_i = 0;
  std::size_t marker_j = 0;
  Eigen::Vector3d rest_m = Eigen::Vector3d::Zero();  ///< r: from i to j without load, in i's axes
  /// K of slow motions, (6 + gaps + slides): loads on j over its motion, both at j in i's axes,
  /// above forces of gaps over openings and those of slides; N, N m; m, rad.
  Stiffness stiffness = Stiffness::Zero(6, 6);
  std::vector<Branch> branches = {};  ///< all of the same size as the stiffness
  LoadCurve bending_curve = {};       ///< table of N m over rad; without it bending is linear
  SlitFriction friction = {};

  Eigen::Index gap_count() const { return stiffness.rows() - 6 - friction.slides; }
  bool has_friction() const { return friction.slides > 0; }
  void check(const std::string& who, const ForceSites& sites) const;
  std::array<std::size_t, 2> markers(const std::vector<Joint>&) const {
    return {marker_i, marker_j};
  }
  static bool resists_turning() { return true; }
  /// With friction, s and its sliding time follow the branches as one more branch.
  std::size_t branch_count() const { return branches.size() + (has_friction() ? 1 : 0); }
  Eigen::Index branch_size() const { return stiffness.rows(); }
  double relaxation_time_s(std::size_t branch) const {
    return branch < branches.size() ? branches[branch].relaxation_time_s : friction.sliding_time_s;
  }
  void act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const;

  /// Returns [e; g] with the gaps for the motion e, without friction.
  /// @param which_open  result: a bit for each gap; its input value is tried first
  Strain with_gaps(const Eigen::Matrix<double, 6, 1>& e, const InternalVariables& internal,
                   int& which_open) const;
};

}  // namespace flexneck::multibody
