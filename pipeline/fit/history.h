// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "pipeline/fit/fit_objective.h"

namespace flexneck::pipeline {

/// A share with the interval that holds it with a confidence of 95 %.
struct Share {
  std::uint64_t count = 0;  ///< that are
  std::uint64_t of = 0;
  double value = 0;
  double low = 0;
  double high = 1;
};

/// The share of independent samples and its interval after Clopper and Pearson (1934), by
/// Boost.Math. Of no samples the interval is [0, 1].
Share share_of(std::uint64_t count, std::uint64_t of);

/// A random point of the prior, a function of seed and number alone: uniform, or normal and cut off
/// at the bounds. In the unit cube.
Eigen::VectorXd prior_point(const FitObjective& objective, std::uint64_t seed,
                            std::uint64_t number);

/// For each target, in the order of the terms, whether observables meet it: of a curve the root of
/// the mean square of its residuals is within the deviations, of a corridor all points are inside.
/// Of all targets, those that are held out, too.
std::vector<bool> met_targets(const FitObjective& objective, const Eigen::VectorXd& values,
                              double deviations);

/// The names of the targets in that order, and whether they are held out.
std::vector<std::pair<std::string, bool>> targets_of(const FitObjective& objective);

}  // namespace flexneck::pipeline
