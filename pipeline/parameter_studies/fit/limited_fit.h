// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pipeline/parameter_studies/fit/least_squares.h"

namespace flexneck::pipeline {

/// Least squares with windows as constraints, by the augmented Lagrangian of Powell and Hestenes
/// for inequalities (Rockafellar, J. Optim. Theory Appl. 12 (1973) 555): a constraint becomes an
/// ordinary window whose edges are moved by the multipliers, so that the problem remains a sum of
/// squares. Chi-squared is that of the other terms.
/// @pre objective.has_limits()
/// @return a minimum, with a problem if no place was found at which the constraints hold
/// @throws FitStopped
Minimum least_squares_within_limits(const FitObjective& objective, const Eigen::VectorXd& start,
                                    const FitSearch& search);

/// The objective with the constraints as ordinary windows, a tenth of their smoothing being one
/// deviation: for a search without constraints.
FitObjective with_limits_as_windows(const FitObjective& objective);

}  // namespace flexneck::pipeline
