// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/history/history.h"

namespace flexneck::pipeline {

/// Runs are sampled at least this often, so that the filters of SAE J211 up to class 1000, which
/// want ten samples per 1 / CFC, can be applied; files hold every so manieth sample.
inline constexpr double kSamplingInterval_s = 1e-4;

/// By how much a study's output interval is divided for that.
int samples_per_output(double output_interval_s);

/// Every so manieth time of a history, and its last.
/// @param every  at least 1
multibody::History thinned(const multibody::History& history, int every);

/// The same of a signal with one value per time.
Eigen::VectorXd thinned(const Eigen::VectorXd& signal, int every);

}  // namespace flexneck::pipeline
