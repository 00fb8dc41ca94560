// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>

#include "geometry/foundation/units.h"

namespace flexneck::pipeline {

/// Height lost by a pendulum of unit length from an angle to its lowest point.
inline double fall(double angle_rad) { return 1 - std::cos(angle_rad); }

/// Velocity at the lowest point of a point pendulum released from rest at an angle.
inline double drop_velocity(double length_m, double angle_rad) {
  return std::sqrt(2 * kStandardGravity_m_s2 * length_m * fall(angle_rad));
}

/// Length of the point pendulum that reaches a velocity.
inline double drop_length(double velocity_m_s, double angle_rad) {
  return velocity_m_s * velocity_m_s / (2 * kStandardGravity_m_s2 * fall(angle_rad));
}

}  // namespace flexneck::pipeline
