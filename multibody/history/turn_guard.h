// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "multibody/history/watched_markers.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Monitors force elements whose loads follow from the rotation vector from one body to another
/// (TurnedForce), which jumps at half a turn: ends the run above 3 rad.
class TurnGuard {
 public:
  /// @param markers  the needed markers are added to it
  TurnGuard(const Model& model, WatchedMarkers& markers);

  /// Checks the rotations, which are followed from one time to the next.
  /// @throws ComputationError naming the element and the time.
  void check(double time_s, const WatchedMarkers& markers);
  /// Largest angular velocity of an element's marker j relative to its marker i.
  double fastest_rad_s(const WatchedMarkers& markers) const;

 private:
  struct Watched {
    std::string title;
    std::size_t place_i, place_j;
    /// Rotation from i to j at the last time; initially the identity.
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  };
  std::vector<Watched> elements_;
};

}  // namespace flexneck::multibody
