// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/forces/force_element.h"

namespace flexneck::multibody {

/// Spring, damper, stops and friction of a joint, acting on one of its coordinates.
struct JointResistance {
  static constexpr std::string_view kName = "resistance";
  static constexpr bool kHasKinks = true;

  std::string name;
  std::size_t joint = 0;
  JointCoordinate coordinate = JointCoordinate::angle;
  Resistance resistance;

  void check(const std::string& who, const ForceSites& sites) const;
  std::array<std::size_t, 2> markers(const std::vector<Joint>& joints) const {
    return {joints[joint].marker_i, joints[joint].marker_j};
  }
  void act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const;
};

}  // namespace flexneck::multibody
