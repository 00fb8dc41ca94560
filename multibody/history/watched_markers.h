// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace flexneck::multibody {

/// Rotations and angular velocities of some of a model's markers at one time.
struct WatchedMarkers {
  struct Motion {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();    ///< marker axes to world
    Eigen::Vector3d w_rad_s = Eigen::Vector3d::Zero();  ///< world
  };
  std::vector<std::size_t> markers;  ///< indices in the model, distinct
  std::vector<Motion> motions;       ///< motions of these markers

  /// The index of a marker in `markers`, to which it is added if missing.
  std::size_t place_of(std::size_t marker) {
    const auto found = std::ranges::find(markers, marker);
    if (found != markers.end()) return static_cast<std::size_t>(found - markers.begin());
    markers.push_back(marker);
    motions.emplace_back();
    return markers.size() - 1;
  }
};

}  // namespace flexneck::multibody
