// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/forces/force_element.h"

namespace flexneck::multibody {

/// A cable in the hole of a part that bends to an arc, between the origins of two markers. Its path
/// is the arc, d / sinc(theta_b / 2), with d the distance of the markers and theta_b the part of
/// j's rotation vector relative to i that is transverse to `axis`. It only pulls, with
///   preload + k x, x < 0;  preload, 0 <= x <= play;  preload + k (x - play) beyond
/// where x is the length of the path less `length_m`. The part's unloaded shape is that under the
/// preload, so that the load is the pull less the preload.
struct Cable {
  static constexpr std::string_view kName = "cable";
  static constexpr bool kHasKinks = true;
  static constexpr std::string_view kKink = "it tightens or goes slack";

  std::string name;
  std::size_t marker_i = 0;
  std::size_t marker_j = 0;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< axis of the part, in i's axes
  /// Length of the path at which the pull is the preload; kAsPlaced if it is the length with the
  /// markers as placed, which the code that places the bodies then sets.
  static constexpr double kAsPlaced = 0;
  double length_m = kAsPlaced;
  double preload_N = 0;
  double stiffness_N_m = 0;
  double play_m = 0;

  /// Length of the path between markers at these positions.
  double path_m(const MarkerKinematics& i, const MarkerKinematics& j) const;
  void check(const std::string& who, const ForceSites& sites) const;
  std::array<std::size_t, 2> markers(const std::vector<Joint>&) const {
    return {marker_i, marker_j};
  }
  static bool resists_turning() { return true; }
  void act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const;
};

}  // namespace flexneck::multibody
