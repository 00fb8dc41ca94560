// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/numerics/prescribed_coordinate.h"

namespace flexneck::multibody {

PrescribedCoordinate::PrescribedCoordinate(double initial_rate, const TimeTable& accelerations,
                                           const SmoothMotion& function, const HeldInput& input)
    : moves_(initial_rate != 0 || !accelerations.times_s().empty() || !function.is_none()),
      value_before_(accelerations.second_integral(0)),
      rate_before_(accelerations.integral(0) - initial_rate),
      table_(accelerations),
      function_(function),
      input_(input) {}

double PrescribedCoordinate::value(double time_s) const {
  return table_.second_integral(time_s) - value_before_ - rate_before_ * time_s +
         function_.displacement_m(time_s) + input_.value_at(time_s);
}

double PrescribedCoordinate::rate(double time_s) const {
  return table_.integral(time_s) - rate_before_ + function_.velocity_m_s(time_s) +
         input_.rate_at(time_s);
}

double PrescribedCoordinate::second_rate(double time_s) const {
  return table_.value(time_s) + function_.acceleration_m_s2(time_s) + input_.second_rate;
}

void PrescribedCoordinate::add_breakpoints(std::vector<double>& times_s) const {
  for (const std::vector<double>* of : {&table_.times_s(), &function_.breakpoints_s()})
    times_s.insert(times_s.end(), of->begin(), of->end());
}

}  // namespace flexneck::multibody
