// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "multibody/forces/force_element.h"

namespace flexneck::multibody {

/// A slender elastic part between two bodies, such as the rubber between two plates: as stiff under
/// small motions as its stiffness says, seen co-rotationally. Its strain e = [w + theta x r / 2;
/// theta] holds the rotation vector theta of marker j against i and
///   w = R_mid^T (p_j - p_i) - sinc(theta_b / 2) r,   R_mid = R_i exp(~theta / 2),
/// with r the rest length and direction and theta_b the part of theta across it: what is bent to an
/// arc of the same length is not stretched. For small motions e is what j has moved, in i's axes.
/// Energy e^T K e / 2, so that loads follow exactly, whatever the rotation (below pi).
/// Maxwell branches add stiffness that relaxes: e^T K e / 2 + sum s^T K_b s / 2, s the strain of
/// the branch's spring (MaxwellBranch).
struct Section {
  static constexpr std::string_view kName = "section";
  static constexpr bool kHolds = true;

  std::string name;
  std::size_t marker_i = 0;
  std::size_t marker_j = 0;
  Eigen::Vector3d rest_m = Eigen::Vector3d::Zero();  ///< r: from i to j without load, i's axes
  /// K, that of slow motions: loads on j over its motion, both at j in i's axes; N, N m; m, rad.
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
  std::vector<MaxwellBranch> branches = {};

  void check(const std::string& who, const ForceSites& sites) const;
  std::array<std::size_t, 2> markers(const std::vector<Joint>&) const {
    return {marker_i, marker_j};
  }
  std::size_t branch_count() const { return branches.size(); }
  void act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const;
};

}  // namespace flexneck::multibody
