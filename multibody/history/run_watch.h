// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "multibody/history/deformation_guard.h"
#include "multibody/history/watched_markers.h"
#include "multibody/model/model.h"
#include "multibody/numerics/counted_angle.h"

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

/// Monitors a run: at its start, at its outputs, after every accepted step (Equations::accept()),
/// and inside steps in which watched markers rotate far. It contains the guards that end or
/// annotate a run, and counts the turns of measured angles.
class RunWatch {
 public:
  explicit RunWatch(const Model& model);

  /// The model's markers whose rotations each look() needs.
  const std::vector<std::size_t>& markers() const { return markers_.markers; }
  /// Sets the motion of a marker.
  /// @param index  index in markers()
  void show(std::size_t index, const Eigen::Matrix3d& R, const Eigen::Vector3d& w_rad_s) {
    markers_.motions[index] = {R, w_rad_s};
  }
  /// Number of calls of look() from the last one to the motion set now, such that rotations between
  /// them are at most one radian by the angular velocities at both ends.
  int looks_until(double time_s) const;
  /// Checks the motion set by show() and counts turns; called in the order of time.
  /// @throws ComputationError, see TurnGuard.
  void look(double time_s);
  /// @throws ComputationError for a deformation beyond the limits of DeformationGuard.
  void check_deformation(double time_s, std::size_t body,
                         const Eigen::Ref<const Eigen::VectorXd>& a) {
    deformation_.check(time_s, body, a);
  }

  /// The measured angles at the last look().
  const AngleCounter& angles() const { return angles_; }
  /// Warnings on results that are not reliable.
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
