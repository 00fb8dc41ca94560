// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pipeline/parameter_studies/fit/fit_objective.h"

namespace flexneck::pipeline {

/// A share of successes with its 95 % confidence interval.
struct Share {
  std::uint64_t count = 0;  ///< number of successes
  std::uint64_t of = 0;
  double value = 0;
  double low = 0;
  double high = 1;
};

/// The share of successes in independent samples and its interval after Clopper and Pearson (1934),
/// by Boost.Math. Without samples the interval is [0, 1].
Share share_of(std::uint64_t count, std::uint64_t of);

/// A random point of the prior in the unit cube, which depends on seed and number alone: uniform,
/// or normal and truncated at the bounds.
Eigen::VectorXd prior_point(const FitObjective& objective, std::uint64_t seed,
                            std::uint64_t number);

/// For each target, in the order of the terms, true if observables meet it: for a curve if the root
/// mean square of its residuals is within the deviations, for a corridor if all points are inside.
/// Targets that are held out are included.
std::vector<bool> met_targets(const FitObjective& objective, const Eigen::VectorXd& values,
                              double deviations);

/// Names of the targets in that order, and whether they are held out.
std::vector<std::pair<std::string, bool>> targets_of(const FitObjective& objective);

}  // namespace flexneck::pipeline
