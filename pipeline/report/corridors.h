// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// A range that a test of a regulation asks a curve to pass through, shown behind the curves of the
/// case that it judges.
struct Corridor {
  std::string experiment;  ///< name of the pendulum's case
  std::string channel;     ///< name of the channel
  std::string what;        ///< "572.33 flexion, peak rotation"
  std::string unit;        ///< of the channel, SI
  Limits times_s, values;  ///< values in that unit
  std::string source;      ///< of the test
};

/// Of the study's tests that are for its dummy and whose case strikes at a velocity that they are
/// for. A peak without limits of its time has no place in a figure.
std::vector<Corridor> corridors_of(const Study& study);

/// Whether a deceleration, linear between its times, keeps to all that a test asks of it.
bool is_inside(const PulseSection& pulse, const CertificationTest& test);

/// A sentence on each pulse in use: its origin, and the tests of the study whose corridor it is
/// inside of as the study gives it.
std::vector<std::string> pulse_remarks(const Study& study);

}  // namespace flexneck::pipeline
