// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/history/turn_guard.h"

#include <cmath>

#include "geometry/foundation/error.h"

namespace flexneck::multibody {

namespace {

constexpr double kLargest_rad = 3;

}  // namespace

TurnGuard::TurnGuard(const Model& model) {
  model.forces.each_kind([&]<class Kind>(const std::vector<Kind>& elements) {
    if constexpr (TurnedForce<Kind>)
      for (const Kind& element : elements)
        if (element.resists_turning())
          elements_.push_back({title(element), element.marker_i, element.marker_j});
  });
}

void TurnGuard::check(double time_s, const History& history, Eigen::Index place) {
  // The real part of a rotation's quaternion is the cosine of half its angle.
  const double least = std::cos(kLargest_rad / 2);
  for (Watched& each : elements_) {
    const double real = history.markers[each.marker_i].rotation.col(place).dot(
        history.markers[each.marker_j].rotation.col(place));
    if (each.sign == 0) each.sign = std::copysign(1.0, real);
    if (each.sign * real < least)
      throw ComputationError(each.title + " is turned by more than 3 rad at " +
                             std::to_string(time_s) +
                             " s: its loads jump at half a turn, so that it cannot turn further");
  }
}

}  // namespace flexneck::multibody
