// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/history/turn_guard.h"

#include <algorithm>
#include <cmath>

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
      throw ComputationError(each.title + " is turned by more than 3 rad at " +
                             rounded_text(time_s) +
                             " s: its loads jump at half a turn, so that it cannot turn further");
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

}  // namespace flexneck::multibody
