// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/model/pulse.h"

#include <utility>

#include "geometry/foundation/error.h"

namespace flexneck::pipeline {

using multibody::TimeTable;

TimeTable braking_pulse(const std::vector<double>& times_s,
                        const std::vector<double>& deceleration_m_s2, double velocity_m_s) {
  const TimeTable pulse(times_s, deceleration_m_s2, TimeTable::Outside::zero);
  const double area = times_s.empty() ? 0 : pulse.integral(times_s.back());
  if (!(area > 0)) {
    throw InputError("expected a pulse that brakes, found one whose integral is " +
                     std::to_string(area) + " in SI units");
  }
  std::vector<double> acceleration = deceleration_m_s2;
  for (double& value : acceleration) value *= -velocity_m_s / area;
  return {times_s, std::move(acceleration), TimeTable::Outside::zero};
}

}  // namespace flexneck::pipeline
