// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/experiments/pendulum.h"
#include "pipeline/output/result_table.h"

namespace flexneck::pipeline {

/// What is known of a case once it was run.
struct PendulumEntry {
  std::string case_name;
  PendulumResult result;
  multibody::SystemMode hanging, weightless;  ///< small motions with and without gravity
};

/// "peaks": largest rotations, acceleration and moments with their times.
ResultTable peak_table(const std::vector<PendulumEntry>& entries);
/// "oscillations": frequency and damping of small motions and of the run.
ResultTable oscillation_table(const std::vector<PendulumEntry>& entries);

}  // namespace flexneck::pipeline
