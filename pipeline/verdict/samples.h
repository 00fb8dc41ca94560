// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include <Eigen/Core>

namespace flexneck::pipeline {

/// @throws std::invalid_argument unless there are two samples or more, one per time, all finite, at
/// strictly increasing times.
void check_samples(const Eigen::VectorXd& time_s, const Eigen::VectorXd& signal);

/// Linear between samples; none beyond them.
std::optional<double> value_at(const Eigen::VectorXd& time_s, const Eigen::VectorXd& signal,
                               double at_s);

/// When a signal that is above a level falls to it for the first time from a time on, linear
/// between samples.
std::optional<double> first_fall(const Eigen::VectorXd& time_s, const Eigen::VectorXd& signal,
                                 double level, double from_s);

}  // namespace flexneck::pipeline
