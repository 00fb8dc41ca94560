// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "pipeline/parameter_studies/fit/fit_objective.h"

namespace flexneck::pipeline {

/// Information of targets and priors about the parameters at a minimum, to first order. Places are
/// in the unit cube.
struct Identifiability {
  /// (p), singular values of the Jacobian of the targets alone, descending.
  Eigen::VectorXd singular_values;
  Eigen::MatrixXd directions;  ///< (p, p), one column each: unit vectors of the cube
  /// (p, p) including the priors; infinite where there is no information.
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd correlations;  ///< (p, p); NaN where there is no information
  /// (targets, p): factor by which a parameter's deviation would grow without the target, whose
  /// terms are taken together; infinite if only this target has information.
  Eigen::MatrixXd widening;
  std::vector<std::string> targets;  ///< names of these targets, in the order of the terms

  /// Standard deviation of a parameter as a fraction of its range.
  double deviation(Eigen::Index parameter) const;
};

/// Smallest singular value at which a direction of the unit cube counts as determined by the
/// targets: below it one standard deviation along the direction is larger than that of the uniform
/// prior itself, 1 / sqrt(12) of the range.
inline constexpr double kLeastSingularValue = 2 * std::numbers::sqrt3;

/// @param jacobian  derivatives of the objective's residuals by the place
Identifiability identifiability(const FitObjective& objective, const Eigen::MatrixXd& jacobian);

/// Parameters of a direction: those with at least half of its largest component, the largest first.
std::vector<Eigen::Index> parameters_along(const Eigen::VectorXd& direction);

/// Quantile of the chi-squared distribution (Boost.Math).
double chi_squared_quantile(double probability, double degrees_of_freedom);

}  // namespace flexneck::pipeline
