// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// A range through which a curve must pass by a regulation's test, shown behind the curves of the
/// case that the test judges.
struct Corridor {
  std::string experiment;  ///< name of the pendulum's case
  std::string channel;     ///< name of the channel
  std::string what;        ///< "572.33 flexion, peak rotation"
  std::string unit;        ///< SI unit of the channel
  Limits times_s, values;  ///< values in `unit`
  std::string source;      ///< source of the test
};

/// Corridors of the study's tests that apply to its dummy and to their case's impact velocity. A
/// peak without limits of its time has no place in a figure.
std::vector<Corridor> corridors_of(const Study& study);

/// Returns whether a deceleration, linear between its times, meets all limits of a test.
bool is_inside(const PulseSection& pulse, const CertificationTest& test);

/// A sentence on each pulse in use: its origin, and the tests of the study whose corridor contains
/// the pulse as given.
std::vector<std::string> pulse_remarks(const Study& study);

}  // namespace flexneck::pipeline
