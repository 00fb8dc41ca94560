// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <numbers>

namespace flexneck::multibody {

/// An angle with counted turns, as last seen. A rotation determines an angle modulo full turns; the
/// turn follows from the angle before and the rates then and now, so that a step may be as long as
/// its error allows.
struct CountedAngle {
  double angle_rad = 0;  ///< initially an approximate start angle
  double rate_rad_s = 0;
  double time_s = 0;
  bool is_seen = false;  ///< time and rate are known

  /// The angle at another time.
  /// @param within_turn_rad  the angle modulo full turns
  CountedAngle at(double now_s, double within_turn_rad, double rate_now_rad_s) const {
    constexpr double kTurn = 2 * std::numbers::pi;
    const double ahead = is_seen ? (now_s - time_s) * (rate_rad_s + rate_now_rad_s) / 2 : 0;
    const double turns = std::round((angle_rad + ahead - within_turn_rad) / kTurn);
    return {within_turn_rad + kTurn * turns, rate_now_rad_s, now_s, true};
  }
};

}  // namespace flexneck::multibody
