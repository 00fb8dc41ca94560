// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "pipeline/fit/least_squares.h"

namespace flexneck::pipeline {

/// Chi-squared over one parameter, all others fitted anew at each of its values (profile
/// likelihood).
struct Profile {
  struct Point {
    double place = 0;  ///< of the parameter, 0 at its lower bound and 1 at its upper one
    double chi_squared = 0;
  };
  std::vector<Point> points;  ///< ascending; the minimum is one of them
  /// Where chi-squared is more by 3.84, the 95 % quantile with one degree of freedom; none where it
  /// is not so within the bounds.
  std::optional<double> low, high;
  /// A better minimum that was come across, of another family; none as a rule.
  std::optional<Minimum> better;
};

/// Walks from a minimum to either side, first by the deviation of the linear theory, then by steps
/// that double until chi-squared is more by 3.84 or the bound is reached, and finds the place there
/// by secants. The others begin where they were at the step before.
/// @param deviation  of the parameter by the linear theory, of its range; may be infinite
/// @throws FitStopped
Profile profile_of(const FitObjective& objective, const Minimum& minimum, Eigen::Index parameter,
                   double deviation, const FitSearch& search);

}  // namespace flexneck::pipeline
