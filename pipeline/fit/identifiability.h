// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "pipeline/fit/fit_objective.h"

namespace flexneck::pipeline {

/// What targets and priors say of the parameters about a minimum, to first order. Places in the
/// unit cube.
struct Identifiability {
  Eigen::VectorXd singular_values;  ///< (p) of the Jacobian of the targets alone, descending
  Eigen::MatrixXd directions;       ///< (p, p), a column for each: unit vectors of the cube
  Eigen::MatrixXd covariance;       ///< (p, p) with the priors; infinite where nothing is said
  Eigen::MatrixXd correlations;     ///< (p, p); NaN where nothing is said
  /// (targets, p): how many times as wide the deviation of a parameter would be without the target,
  /// whose terms are taken together; infinite where it alone says something.
  Eigen::MatrixXd widening;
  std::vector<std::string> targets;  ///< that these are, in the order of the terms

  /// Standard deviation of a parameter, of its range.
  double deviation(Eigen::Index parameter) const;
};

/// A direction of the unit cube whose singular value is below this is fixed by no target: one
/// standard deviation along it is more than that of the uniform prior itself, 1 / sqrt(12) of the
/// range.
inline constexpr double kLeastSingularValue = 2 * std::numbers::sqrt3;

/// @param jacobian  of the objective's residuals by the place, as it has them
Identifiability identifiability(const FitObjective& objective, const Eigen::MatrixXd& jacobian);

/// The parameters that a direction is made of: those with at least half of its largest component,
/// the largest first.
std::vector<Eigen::Index> parameters_along(const Eigen::VectorXd& direction);

/// Quantile of the chi-squared distribution with some degrees of freedom (Boost.Math).
double chi_squared_quantile(double probability, double degrees_of_freedom);

}  // namespace flexneck::pipeline
