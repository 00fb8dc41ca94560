// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "multibody/files/history_file.h"
#include "pipeline/language/study/measured_section.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

/// A test with measured data of the user, and the run of its case if there is one.
struct MeasuredRun {
  MeasuredTest test;
  std::optional<multibody::HistoryFile> run;
};

/// Table "measured curves": ratings of computed curves against measured ones, a line for each.
/// @throws InputError for a channel that the run lacks, a unit of another dimension, and curves
/// that cannot be rated, as resampled().
ResultTable measured_curve_table(const std::vector<MeasuredRun>& runs);

/// Table "measured limits": agreement of computed curves with corridors, and of figures with their
/// limits.
/// @throws InputError as measured_curve_table(), and for a corridor that the run does not cover.
ResultTable measured_limit_table(const std::vector<MeasuredRun>& runs);

/// A channel of a run as a curve, in SI units.
Curve computed_curve(const multibody::HistoryFile& run, const std::string& channel);

}  // namespace flexneck::pipeline
