// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "pipeline/parameter_studies/fit/least_squares.h"

namespace flexneck::pipeline {

/// Chi-squared over one parameter, with all others fitted anew at each of its values (profile
/// likelihood).
struct Profile {
  struct Point {
    double place = 0;  ///< place of the parameter, 0 at its lower bound and 1 at its upper one
    double chi_squared = 0;
  };
  std::vector<Point> points;  ///< ascending, including the minimum
  /// Places where chi-squared has increased by 3.84, the 95 % quantile with one degree of freedom;
  /// none where that is not reached within the bounds.
  std::optional<double> low, high;
  /// A better minimum, of another family, found on the way; usually none.
  std::optional<Minimum> better;
};

/// Walks from a minimum to either side, first by the deviation of the linear theory, then by
/// doubling steps until chi-squared has increased by 3.84 or the bound is reached, and finds the
/// place of that increase by regula falsi. The other parameters start from their values at the
/// previous step.
/// @param deviation  linear-theory deviation of the parameter, as a fraction of its range; may be
/// infinite
/// @throws FitStopped
Profile profile_of(const FitObjective& objective, const Minimum& minimum, Eigen::Index parameter,
                   double deviation, const FitSearch& search);

}  // namespace flexneck::pipeline
