// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "pipeline/parameter_studies/fit/least_squares.h"

namespace flexneck::pipeline {

/// Minima that are considered the same: in each parameter they lie within kSamePlace of one
/// another, as a fraction of its range.
struct Family {
  Minimum best;                     ///< the lowest minimum of the family
  std::vector<std::size_t> starts;  ///< numbers of the starts whose fits ended there
  /// True if the family is as good as the best one: its chi-squared is larger by at most the 95 %
  /// quantile with as many degrees of freedom as there are parameters.
  bool is_as_good = false;
  /// True if it meets the targets: chi-squared is below the 95 % quantile with the number of
  /// targets minus that of parameters as degrees of freedom, at least one.
  bool meets_targets = false;
};

inline constexpr double kSamePlace = 0.02;

/// Groups fits into families, the best one first; failed fits are left out.
std::vector<Family> families_of(const FitObjective& objective, const std::vector<Minimum>& minima);

/// The largest chi-squared at which a minimum meets the targets.
double largest_good_chi_squared(const FitObjective& objective);

}  // namespace flexneck::pipeline
