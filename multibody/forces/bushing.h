// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/forces/force_element.h"

namespace flexneck::multibody {

/// A linear spring and damper in all six directions between two markers: e = [d; theta], d the
/// position and theta the rotation vector of j relative to i, both in i's axes. Its energy is e^T K
/// e / 2, so that its moment is exact for finite rotations; the damper's load is C [d'; angular
/// velocity of j relative to i].
struct Bushing {
  static constexpr std::string_view kName = "bushing";

  std::string name;
  std::size_t marker_i = 0;
  std::size_t marker_j = 0;
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();  ///< N, N m; m, rad
  Eigen::Matrix<double, 6, 6> damping = Eigen::Matrix<double, 6, 6>::Zero();    ///< per s

  void check(const std::string& who, const ForceSites& sites) const;
  std::array<std::size_t, 2> markers(const std::vector<Joint>&) const {
    return {marker_i, marker_j};
  }
  bool resists_turning() const { return !stiffness.rightCols<3>().isZero(0); }
  void act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const;
};

}  // namespace flexneck::multibody
