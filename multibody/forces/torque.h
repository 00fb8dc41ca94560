// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/forces/force_element.h"

namespace flexneck::multibody {

/// A torque on a marker's body, fixed in the world's axes or, as a follower, in the marker's. It
/// has no potential.
struct Torque {
  static constexpr std::string_view kName = "torque";

  std::string name;
  std::size_t marker = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit vector in these axes
  TimeTable magnitude_Nm;
  bool follows = false;  ///< its direction turns with the marker
  double input_Nm = 0;   ///< added to the table

  void check(const std::string& who, const ForceSites& sites) const {
    check_marker(who, marker, sites);
    check_direction(who, direction);
  }
  std::array<std::size_t, 1> markers(const std::vector<Joint>&) const { return {marker}; }
  const TimeTable& load_over_time() const { return magnitude_Nm; }
  bool keeps_direction() const { return !follows; }
  void act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const {
    load.moment_Nm = (magnitude_Nm.value(input.time_s) + input_Nm) * direction;
    if (follows) load.moment_Nm = (input.j.R * load.moment_Nm).eval();
    sums.work_W += load.moment_Nm.dot(input.j.w);
  }
};

}  // namespace flexneck::multibody
