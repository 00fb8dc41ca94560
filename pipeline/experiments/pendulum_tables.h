// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "multibody/analysis/linearisation.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/output/result_table.h"

namespace flexneck::pipeline {

/// What is known of a case once it was run.
struct PendulumEntry {
  CaseSection experiment;
  FittedPulse pulse;
  PendulumResult result;
  multibody::SystemMode hanging, weightless;  ///< small motions with and without gravity
  std::optional<IntegrationCost> cost;        ///< where a rigid neck is compared
};

/// "peaks": largest rotations, acceleration and moments with their times.
ResultTable peak_table(const Study& study, const std::vector<PendulumEntry>& entries);
/// "oscillations": frequency and damping of small motions and of the run.
ResultTable oscillation_table(const std::vector<PendulumEntry>& entries);

/// A figure that may not be there, times a factor.
std::string text_of(const std::optional<double>& value, const char* format, double factor = 1);

}  // namespace flexneck::pipeline
