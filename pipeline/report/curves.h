// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "pipeline/report/results.h"

namespace flexneck::pipeline {

/// Of a run alone on its page: a screen has hardly more points in a row.
inline constexpr Eigen::Index kMaxSamples = 1001;

/// The channels of all runs in SI units, the units in which the paper shows them, and the corridors
/// that stand behind them, as page/plots.js reads it. Null if no run has channels.
/// @param most_samples of a run
nlohmann::ordered_json curves_of(const Results& results, const Study& study,
                                 Eigen::Index most_samples = kMaxSamples);

/// The unit in which a quantity of that SI unit is shown: "deg" for "rad". Itself if there is none.
std::string shown_unit(const std::string& si_unit, Experiment::Kind kind);

}  // namespace flexneck::pipeline
