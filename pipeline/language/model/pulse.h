// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "multibody/numerics/time_table.h"

namespace flexneck::pipeline {

/// A pulse that brings a body to rest: the acceleration along its velocity, which is the given
/// deceleration scaled so that its integral is that velocity.
/// @throws InputError if the deceleration does not brake.
multibody::TimeTable braking_pulse(const std::vector<double>& times_s,
                                   const std::vector<double>& deceleration_m_s2,
                                   double velocity_m_s);

/// Scaling of a pulse whose integral differs from the velocity to be removed.
enum class PulseFit {
  amplitude,  ///< the deceleration is multiplied by a factor
  duration,   ///< the times are scaled, from its first time on
  none        ///< the pulse is not scaled
};

/// A pulse for a velocity.
struct FittedPulse {
  std::vector<double> times_s;
  std::vector<double> deceleration_m_s2;
  double area_m_s = 0;  ///< integral of the given deceleration
  double amplitude_factor = 1;
  double duration_factor = 1;
  double velocity_left_m_s = 0;  ///< velocity after the pulse

  /// Acceleration along the velocity, times a factor.
  multibody::TimeTable acceleration(double factor = 1) const;
};

/// Fits a pulse to a velocity. @throws InputError if the deceleration does not brake.
FittedPulse fitted_pulse(const std::vector<double>& times_s,
                         const std::vector<double>& deceleration_m_s2, double velocity_m_s,
                         PulseFit fit);

}  // namespace flexneck::pipeline
