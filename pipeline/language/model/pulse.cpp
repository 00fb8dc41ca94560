// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/pulse.h"

#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"

namespace flexneck::pipeline {

using multibody::TimeTable;

TimeTable FittedPulse::acceleration(double factor) const {
  std::vector<double> values = deceleration_m_s2;
  for (double& value : values) value *= -factor;
  return {times_s, std::move(values), TimeTable::Outside::zero};
}

TimeTable braking_pulse(const std::vector<double>& times_s,
                        const std::vector<double>& deceleration_m_s2, double velocity_m_s) {
  return fitted_pulse(times_s, deceleration_m_s2, velocity_m_s, PulseFit::amplitude).acceleration();
}

FittedPulse fitted_pulse(const std::vector<double>& times_s,
                         const std::vector<double>& deceleration_m_s2, double velocity_m_s,
                         PulseFit fit) {
  const TimeTable given(times_s, deceleration_m_s2, TimeTable::Outside::zero);
  FittedPulse pulse;
  pulse.area_m_s = times_s.empty() ? 0 : given.integral(times_s.back());
  if (!(pulse.area_m_s > 0)) {
    throw InputError("expected a decelerating pulse, found one whose integral is " +
                     rounded_text(pulse.area_m_s) + " in SI units");
  }
  const double factor = velocity_m_s / pulse.area_m_s;
  if (fit == PulseFit::amplitude) pulse.amplitude_factor = factor;
  if (fit == PulseFit::duration) pulse.duration_factor = factor;
  pulse.times_s = times_s;
  for (double& time : pulse.times_s)
    time = times_s.front() + (time - times_s.front()) * pulse.duration_factor;
  pulse.deceleration_m_s2 = deceleration_m_s2;
  for (double& value : pulse.deceleration_m_s2) value *= pulse.amplitude_factor;
  // For a scaled pulse the remainder is rounding error.
  if (fit == PulseFit::none) pulse.velocity_left_m_s = velocity_m_s - pulse.area_m_s;
  return pulse;
}

}  // namespace flexneck::pipeline
