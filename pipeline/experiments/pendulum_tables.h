// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "multibody/analysis/linearisation.h"
#include "pipeline/experiments/pendulum.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

/// Data of a case after its run.
struct PendulumEntry {
  CaseSection experiment;
  FittedPulse pulse;
  PendulumResult result;
  multibody::SystemMode hanging, weightless;  ///< small motions with and without gravity
  std::optional<IntegrationCost> cost;        ///< present if the case is compared with a rigid neck
};

/// Table "peaks": largest rotations, acceleration and moments with their times.
ResultTable peak_table(const Study& study, const std::vector<PendulumEntry>& entries);
/// Table "oscillations": frequency and damping of small motions and of the run.
ResultTable oscillation_table(const std::vector<PendulumEntry>& entries);

/// Text of an optional figure, times a factor.
std::string text_of(const std::optional<double>& value, const char* format, double factor = 1);

}  // namespace flexneck::pipeline
