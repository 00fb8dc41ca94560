// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/fit/least_squares.h"

namespace flexneck::pipeline {

/// Least squares with windows that must hold, by the augmented Lagrangian of Powell and Hestenes
/// for inequalities (Rockafellar, J. Optim. Theory Appl. 12 (1973) 555): a window is one that
/// counts, with its edges moved by the multipliers, which makes squares of what is squares anyway.
/// Chi-squared is that of the other terms.
/// @pre objective.has_limits()
/// @return a minimum with a problem if none was found where they hold
/// @throws FitStopped
Minimum least_squares_within_limits(const FitObjective& objective, const Eigen::VectorXd& start,
                                    const FitSearch& search);

/// The objective with these windows as ones that count, a tenth of their smoothing being one
/// deviation: for a search that knows of no limits.
FitObjective with_limits_as_windows(const FitObjective& objective);

}  // namespace flexneck::pipeline
