// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

namespace flexneck::pipeline {

/// A confidence interval of 95 %.
struct Interval {
  double low = 0;
  double high = 0;
};

/// An estimate with its confidence interval.
struct Estimate {
  double value = 0;
  Interval interval;
};

/// Estimates of several figures from a number of independent samples.
/// @param figures_of  figures of a resample, given as the indices of its members
struct Resampling {
  Eigen::Index samples = 0;
  std::uint64_t seed = 1;
  std::function<Eigen::VectorXd(const std::vector<Eigen::Index>& members)> figures_of;
};

/// The figures of the samples themselves, and the percentiles 2.5 and 97.5 of those of 1000
/// resamples drawn with replacement (Efron's percentile method).
std::vector<Estimate> bootstrap(const Resampling& of);

/// Quantile of the values, linear between two of them (type 7 of Hyndman and Fan 1996).
/// @param sorted  ascending, at least one
double sorted_quantile(const Eigen::VectorXd& sorted, double share);

}  // namespace flexneck::pipeline
