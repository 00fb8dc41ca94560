// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "pipeline/study/sweep_section.h"

namespace flexneck::pipeline {

/// Phi(z), the standard normal distribution function.
double normal_cdf(double z);
/// Its inverse. @pre 0 < probability < 1
double normal_quantile(double probability);

/// The value that a continuous distribution exceeds with probability 1 - `probability`, in the unit
/// of the parameter. A normal distribution may be cut off below and above; mean and standard
/// deviation are then those of the whole one. Mean and standard deviation of a lognormal one are
/// those of the value: log x has the variance log(1 + (s / m)^2) and the mean log m less half of
/// that.
/// @pre 0 < probability < 1
double quantile(const SweepDistribution& distribution, double probability);

/// The same of a discrete one: the position of its value.
std::size_t discrete_quantile(const SweepDistribution& distribution, double probability);

}  // namespace flexneck::pipeline
