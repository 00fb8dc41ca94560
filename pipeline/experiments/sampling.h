// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/history/history.h"

namespace flexneck::pipeline {

/// Largest sampling interval of runs: the filters of SAE J211 up to class 1000 need ten samples per
/// 1 / CFC. Files hold every n-th sample.
inline constexpr double kSamplingInterval_s = 1e-4;

/// Number of samples per output interval of the study that keeps to this interval.
int samples_per_output(double output_interval_s);

/// Every n-th time of a history, and its last.
/// @param every  n, at least 1
multibody::History thinned(const multibody::History& history, int every);

/// Every n-th value of a signal with one value per time, and its last.
Eigen::VectorXd thinned(const Eigen::VectorXd& signal, int every);

}  // namespace flexneck::pipeline
