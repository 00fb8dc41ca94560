// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/forces/force_element.h"

namespace flexneck::multibody {

/// An actuator: a force along the line between the origins of two markers that follows a table of
/// time. A positive one pushes them apart. Where the origins coincide, no load acts.
struct LineForce {
  static constexpr std::string_view kName = "line_force";

  std::string name;
  std::size_t marker_i = 0;
  std::size_t marker_j = 0;
  TimeTable magnitude_N;
  double input_N = 0;  ///< added to the table

  void check(const std::string& who, const ForceSites& sites) const {
    check_pair(who, marker_i, marker_j, sites);
  }
  std::array<std::size_t, 2> markers(const std::vector<Joint>&) const {
    return {marker_i, marker_j};
  }
  const TimeTable& load_over_time() const { return magnitude_N; }
  void act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const {
    const Eigen::Vector3d line = input.j.p - input.i.p;
    const double length = line.norm();
    if (!(length > kNoDirection)) return;
    const double magnitude = magnitude_N.value(input.time_s) + input_N;
    load.force_N = magnitude / length * line;
    sums.work_W += load.force_N.dot(input.j.v - input.i.v);
    sums.potential_J -= magnitude * length;
  }
};

}  // namespace flexneck::multibody
