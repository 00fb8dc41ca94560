// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/history/angle_counter.h"
#include "multibody/history/deformation_guard.h"
#include "multibody/history/turn_guard.h"
#include "multibody/history/watched_markers.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Watches a run besides what the run records: at its start, at its outputs and behind every
/// accepted step (Equations::accept()), and inside of steps in which watched markers turn far. It
/// has the guards that end or annotate a run, and counts the turns of measured angles.
class RunWatch {
 public:
  explicit RunWatch(const Model& model);

  /// The model's markers whose rotations are needed at each look.
  const std::vector<std::size_t>& markers() const { return markers_.markers; }
  /// @param index  among markers()
  void show(std::size_t index, const Eigen::Matrix3d& R, const Eigen::Vector3d& w_rad_s) {
    markers_.motions[index] = {R, w_rad_s};
  }
  /// How many looks bring a run from the last one to what is shown now, at most a radian apart by
  /// the angular velocities here and there.
  int looks_until(double time_s) const;
  /// Takes what is shown, in the order of time. @throws ComputationError, see TurnGuard.
  void look(double time_s);
  /// @throws ComputationError for a body that is deformed beyond reason, see DeformationGuard.
  void check_deformation(double time_s, std::size_t body,
                         const Eigen::Ref<const Eigen::VectorXd>& a) {
    deformation_.check(time_s, body, a);
  }

  /// At the last look.
  const AngleCounter& angles() const { return angles_; }
  /// Sentences on what of the results is not to be trusted.
  std::vector<std::string> warnings() const { return deformation_.warnings(); }

 private:
  double fastest_rad_s() const;

  WatchedMarkers markers_;
  DeformationGuard deformation_;
  TurnGuard turns_;
  AngleCounter angles_;
  double looked_s_ = 0;
  double looked_fastest_rad_s_ = 0;
};

}  // namespace flexneck::multibody
