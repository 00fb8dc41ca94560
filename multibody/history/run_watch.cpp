// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/history/run_watch.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::multibody {

namespace {

constexpr double kLargest_rad = 3;

}  // namespace

TurnGuard::TurnGuard(const Model& model, WatchedMarkers& markers) {
  model.forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    if constexpr (TurnedForce<Kind>)
      for (const Kind& element : elements)
        if (element.resists_turning())
          elements_.push_back({title(element), markers.place_of(element.marker_i),
                               markers.place_of(element.marker_j)});
  });
}

void TurnGuard::check(double time_s, const WatchedMarkers& markers) {
  // The real part of a rotation's quaternion is the cosine of half its angle.
  const double least = std::cos(kLargest_rad / 2);
  for (Watched& each : elements_) {
    Eigen::Quaterniond q(Eigen::Matrix3d(markers.motions[each.place_i].R.transpose() *
                                         markers.motions[each.place_j].R));
    // A rotation has two quaternions: take the one near the last.
    if (q.dot(each.rotation) < 0) q.coeffs() = -q.coeffs();
    each.rotation = q;
    if (q.w() < least)
      throw ComputationError(
          each.title + " is rotated by more than 3 rad at " + rounded_text(time_s) +
          " s; its loads would jump at a rotation of pi, so that it cannot rotate further");
  }
}

double TurnGuard::fastest_rad_s(const WatchedMarkers& markers) const {
  double fastest = 0;
  for (const Watched& each : elements_)
    fastest = std::max(
        fastest,
        (markers.motions[each.place_j].w_rad_s - markers.motions[each.place_i].w_rad_s).norm());
  return fastest;
}

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// The angle of the rotation about an axis that is nearest to a rotation q, modulo full turns, and
/// its rate.
/// @param w  angular velocity in the axes to which q leads
CountedAngle about(const Vector3d& axis, const Quaterniond& q, const Vector3d& w) {
  // 2 atan(s / c) with q' = w q / 2.
  const double c = q.w();
  const double s = q.vec().dot(axis);
  const double c_rate = -w.dot(q.vec()) / 2;
  const double s_rate = axis.dot(c * w + w.cross(q.vec())) / 2;
  const double square = c * c + s * s;
  return {.angle_rad = 2 * std::atan2(c < 0 ? -s : s, std::abs(c)),
          .rate_rad_s = square > 0 ? 2 * (c * s_rate - s * c_rate) / square : 0};
}

}  // namespace

AngleCounter::AngleCounter(const Model& model, WatchedMarkers& markers) {
  for (const MeasuredAngle& each : model.angles) {
    Angle angle{markers.place_of(each.marker), {}, each.axis, {.angle_rad = each.start_rad}};
    if (each.relative_to) angle.place_from = markers.place_of(*each.relative_to);
    angles_.push_back(angle);
  }
}

/// Motion of the measured marker in the axes of the marker from which the angle is measured.
WatchedMarkers::Motion AngleCounter::relative(const Angle& angle, const WatchedMarkers& markers) {
  const WatchedMarkers::Motion& motion = markers.motions[angle.place];
  if (!angle.place_from) return motion;
  const WatchedMarkers::Motion& from = markers.motions[*angle.place_from];
  return {from.R.transpose() * motion.R, from.R.transpose() * (motion.w_rad_s - from.w_rad_s)};
}

void AngleCounter::count(double time_s, const WatchedMarkers& markers) {
  for (Angle& each : angles_) {
    const WatchedMarkers::Motion motion = relative(each, markers);
    const CountedAngle now = about(each.axis, Quaterniond(motion.R), motion.w_rad_s);
    each.counted = each.counted.at(time_s, now.angle_rad, now.rate_rad_s);
  }
}

double AngleCounter::fastest_rad_s(const WatchedMarkers& markers) const {
  double fastest = 0;
  for (const Angle& each : angles_)
    fastest = std::max(fastest, relative(each, markers).w_rad_s.norm());
  return fastest;
}

RunWatch::RunWatch(const Model& model)
    : deformation_(model), turns_(model, markers_), angles_(model, markers_) {}

double RunWatch::fastest_rad_s() const {
  return std::max(turns_.fastest_rad_s(markers_), angles_.fastest_rad_s(markers_));
}

int RunWatch::looks_until(double time_s) const {
  constexpr double kApart_rad = 1;
  constexpr double kMost = 1e6;  // consecutive states are so far apart only if rates diverge
  const double turned =
      (time_s - looked_s_) * std::max(looked_fastest_rad_s_, fastest_rad_s()) / kApart_rad;
  return 1 + static_cast<int>(turned < kMost ? turned : kMost);
}

void RunWatch::look(double time_s) {
  turns_.check(time_s, markers_);
  angles_.count(time_s, markers_);
  looked_s_ = time_s;
  looked_fastest_rad_s_ = fastest_rad_s();
}

}  // namespace flexneck::multibody
