// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "multibody/history/watched_markers.h"
#include "multibody/model/model.h"
#include "multibody/numerics/counted_angle.h"

namespace flexneck::multibody {

/// Counts the turns of a model's measured angles along a run.
class AngleCounter {
 public:
  /// @param markers  the needed markers are added to it
  AngleCounter(const Model& model, WatchedMarkers& markers);

  void count(double time_s, const WatchedMarkers& markers);
  /// Largest angular velocity of a measured marker relative to the one from which it is measured.
  double fastest_rad_s(const WatchedMarkers& markers) const;
  std::size_t size() const { return angles_.size(); }
  double angle_rad(std::size_t index) const { return angles_[index].counted.angle_rad; }

 private:
  struct Angle {
    std::size_t place;
    std::optional<std::size_t> place_from;  ///< none: the world
    Eigen::Vector3d axis;
    CountedAngle counted;
  };
  static WatchedMarkers::Motion relative(const Angle& angle, const WatchedMarkers& markers);

  std::vector<Angle> angles_;
};

}  // namespace flexneck::multibody
