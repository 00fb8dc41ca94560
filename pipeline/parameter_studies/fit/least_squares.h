// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/parameter_studies/fit/fit_objective.h"

namespace flexneck::pipeline {

/// Result of a fit.
struct Minimum {
  Eigen::VectorXd place;   ///< (p) in the unit cube
  Eigen::VectorXd values;  ///< observables there; empty for a failed fit
  double chi_squared = 0;  ///< sum of the squared residuals, priors included
  int evaluations = 0;     ///< evaluations of the model
  bool has_converged = false;
  std::string problem;  ///< reason why a fit failed; else empty

  bool has_failed() const { return !problem.empty(); }
};

/// Settings of a fit.
struct FitSearch {
  int steps = 40;                  ///< maximum number of steps
  std::vector<bool> is_held = {};  ///< parameters that are kept constant; empty: none
  const std::atomic<bool>* is_stopped = nullptr;  ///< set by the user; null: never
};

/// Thrown when the user has stopped a fit.
struct FitStopped : std::runtime_error {
  FitStopped() : std::runtime_error("stopped") {}
};

/// Least squares from a starting place by the Levenberg-Marquardt method (MINPACK's lmder, Moré
/// 1978, in Eigen). Bounds are kept by a change of variables, u = (1 + sin x) / 2 for each
/// parameter (James and Roos 1975, MINUIT): a minimum at a bound is reached, with u at it to 1e-4
/// or so. A start at a bound is moved in by 1 %, since the sine is flat there. A place at which the
/// model fails counts as infinitely bad, so that the step to it is shortened. Windows that are
/// constraints are handled by least_squares_within_limits().
/// @throws FitStopped
Minimum least_squares(const FitObjective& objective, const Eigen::VectorXd& start,
                      const FitSearch& search);

/// Distance from a bound, as a fraction of its range, within which a parameter counts as at it.
inline constexpr double kAtBound = 1e-3;

/// True if a parameter of a place is at one of its bounds.
bool is_at_bound(double place);

}  // namespace flexneck::pipeline
