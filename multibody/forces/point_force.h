// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/forces/force_element.h"

namespace flexneck::multibody {

/// A force at a marker's origin, fixed in the world's axes or, as a follower force, in the
/// marker's.
struct PointForce {
  static constexpr std::string_view kName = "force";

  std::string name;
  std::size_t marker = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< unit vector in these axes
  TimeTable magnitude_N;
  bool follows = false;  ///< its direction turns with the marker
  double input_N = 0;    ///< added to the table

  void check(const std::string& who, const ForceSites& sites) const {
    check_marker(who, marker, sites);
    check_direction(who, direction);
  }
  std::array<std::size_t, 1> markers(const std::vector<Joint>&) const { return {marker}; }
  const TimeTable& load_over_time() const { return magnitude_N; }
  bool keeps_direction() const { return !follows; }
  void act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const {
    load.force_N = (magnitude_N.value(input.time_s) + input_N) * direction;
    if (follows) load.force_N = (input.j.R * load.force_N).eval();
    sums.work_W += load.force_N.dot(input.j.v);
    // A follower force has no potential.
    if (!follows) sums.potential_J -= load.force_N.dot(input.j.p);
  }
};

}  // namespace flexneck::multibody
