// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/history/history.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Watches force elements whose loads follow from the rotation vector from one body to another
/// (TurnedForce), which jumps at half a turn: ends the run above 3 rad.
class TurnGuard {
 public:
  explicit TurnGuard(const Model& model);

  /// At an output whose markers are recorded; rotations are followed from one to the next.
  /// @param place  of the output in the history
  /// @throws ComputationError naming the element and the time.
  void check(double time_s, const History& history, Eigen::Index place);

 private:
  struct Watched {
    std::string title;
    std::size_t marker_i, marker_j;
    double sign = 0;  ///< that makes the quaternion from i to j positive at the start
  };
  std::vector<Watched> elements_;
};

}  // namespace flexneck::multibody
