// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "multibody/numerics/time_table.h"

namespace flexneck::pipeline {

/// A pulse that brings a body to rest: the acceleration along its velocity, the given deceleration
/// scaled so that its integral is that velocity.
/// @throws InputError if the deceleration does not brake.
multibody::TimeTable braking_pulse(const std::vector<double>& times_s,
                                   const std::vector<double>& deceleration_m_s2,
                                   double velocity_m_s);

/// What is done to a pulse whose integral is not the velocity it has to take away.
enum class PulseFit {
  amplitude,  ///< the deceleration is multiplied
  duration,   ///< it lasts longer or shorter, from its first time on
  none        ///< it is taken as it is
};

/// A pulse for a velocity.
struct FittedPulse {
  std::vector<double> times_s;
  std::vector<double> deceleration_m_s2;
  double area_m_s = 0;  ///< integral of the deceleration given
  double amplitude_factor = 1;
  double duration_factor = 1;
  double velocity_left_m_s = 0;  ///< after the pulse

  /// Acceleration along the velocity, times a factor.
  multibody::TimeTable acceleration(double factor = 1) const;
};

/// @throws InputError if the deceleration does not brake.
FittedPulse fitted_pulse(const std::vector<double>& times_s,
                         const std::vector<double>& deceleration_m_s2, double velocity_m_s,
                         PulseFit fit);

}  // namespace flexneck::pipeline
