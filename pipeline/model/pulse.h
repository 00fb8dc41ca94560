// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "multibody/time_table.h"

namespace flexneck::pipeline {

/// A pulse that brings a body to rest: the acceleration along its velocity, the given deceleration
/// scaled so that its integral is that velocity.
/// @throws InputError if the deceleration does not brake.
multibody::TimeTable braking_pulse(const std::vector<double>& times_s,
                                   const std::vector<double>& deceleration_m_s2,
                                   double velocity_m_s);

}  // namespace flexneck::pipeline
