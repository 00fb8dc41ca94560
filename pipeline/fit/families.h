// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/fit/least_squares.h"

namespace flexneck::pipeline {

/// Minima that are one and the same: they lie within kSamePlace of one another in each parameter,
/// of its range.
struct Family {
  Minimum best;                     ///< of them
  std::vector<std::size_t> starts;  ///< whose fits ended there
  /// Whether it is as good as the best family: chi-squared is more by no more than the 95 %
  /// quantile with as many degrees of freedom as there are parameters.
  bool is_as_good = false;
  /// Whether it meets the targets: chi-squared is below the 95 % quantile with as many degrees of
  /// freedom as there are more targets than parameters, one at least.
  bool meets_targets = false;
};

inline constexpr double kSamePlace = 0.02;

/// The families of fits, the best one first; fits that failed have none.
std::vector<Family> families_of(const FitObjective& objective, const std::vector<Minimum>& minima);

/// The chi-squared up to which a minimum meets the targets.
double largest_good_chi_squared(const FitObjective& objective);

}  // namespace flexneck::pipeline
