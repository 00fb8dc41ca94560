// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/forces/force_element.h"

namespace flexneck::multibody {

/// A spring and damper between the origins of two markers, along the line between them. Its
/// deflection is their distance less the free length.
struct MarkerSpring {
  static constexpr std::string_view kName = "spring";
  static constexpr bool kHasKinks = true;

  std::string name;
  std::size_t marker_i = 0;
  std::size_t marker_j = 0;
  double free_length_m = 0;
  Resistance resistance;

  void check(const std::string& who, const ForceSites& sites) const;
  std::array<std::size_t, 2> markers(const std::vector<Joint>&) const {
    return {marker_i, marker_j};
  }
  void act(const ForceInput& input, ForceLoad& load, ForceEnergies& sums) const;
};

}  // namespace flexneck::multibody
