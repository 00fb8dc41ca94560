// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// Maximum number of samples of a run alone on its page, about the horizontal pixels of a screen.
inline constexpr Eigen::Index kMaxSamples = 1001;

/// The channels of all runs in SI units, the units in which the paper shows them, and the corridors
/// behind them, in the form that page/plots.js reads. Null if no run has channels.
/// @param most_samples  maximum number of samples of a run
nlohmann::ordered_json curves_of(const Results& results, const Study& study,
                                 Eigen::Index most_samples = kMaxSamples);

/// Display unit of a quantity by its SI unit: "deg" for "rad"; the SI unit itself if there is none.
std::string shown_unit(const std::string& si_unit, Experiment::Kind kind);

}  // namespace flexneck::pipeline
