// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

#include "pipeline/language/study/sweep_section.h"

namespace flexneck::pipeline {

/// Phi(z), the standard normal distribution function.
double normal_cdf(double z);
/// The inverse of Phi. @pre 0 < probability < 1
double normal_quantile(double probability);

/// Quantile of a continuous distribution, in the unit of the parameter: the value below which lies
/// `probability`. A normal distribution may be truncated below and above; mean and standard
/// deviation are then those of the untruncated one. Mean and standard deviation of a lognormal one
/// are those of the value: log x has the variance log(1 + (s / m)^2) and the mean log m minus half
/// of that.
/// @pre 0 < probability < 1
double quantile(const SweepDistribution& distribution, double probability);

/// Index of the value that is the quantile of a discrete distribution.
std::size_t discrete_quantile(const SweepDistribution& distribution, double probability);

}  // namespace flexneck::pipeline
