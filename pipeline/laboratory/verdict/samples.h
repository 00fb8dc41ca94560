// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

namespace flexneck::pipeline {

/// Checks a sampled signal.
/// @throws std::invalid_argument unless there are at least two samples, one per time, all finite,
/// at strictly increasing times.
void check_samples(const Eigen::VectorXd& time_s, const Eigen::VectorXd& signal);

/// Value interpolated linearly between samples; none beyond them.
std::optional<double> value_at(const Eigen::VectorXd& time_s, const Eigen::VectorXd& signal,
                               double at_s);

/// Time at which a signal above a level first falls to it after a given time, interpolated linearly
/// between samples.
std::optional<double> first_fall(const Eigen::VectorXd& time_s, const Eigen::VectorXd& signal,
                                 double level, double from_s);

}  // namespace flexneck::pipeline
