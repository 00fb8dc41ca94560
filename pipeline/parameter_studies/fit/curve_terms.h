// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "pipeline/language/study/fit_section.h"
#include "pipeline/parameter_studies/fit/fit_objective.h"

namespace flexneck::pipeline {

/// Times of the points at which a target's curve is compared, shape (points).
Eigen::VectorXd times_of_points(const FitCurve& wanted);

/// Observables of a curve for a target: its values at these times, linear between its samples; or
/// its rating against the target's curve.
/// @param computed  the curve with its unit
/// @throws InputError as the ratings do.
Eigen::VectorXd observables_of_curve(const FitCurve& wanted, const Curve& computed);

/// Terms of a target with a curve: one for each point, with its deviation or as a window of the
/// corridor; or a single one for the rating.
/// @param si_unit  unit of the curve
/// @throws InputError with file, line and key, as value_term() and window_term() do; for units of
/// another dimension, with the key "curve".
std::vector<FitTerm> curve_terms(const FitTarget& target, const std::string& si_unit);

}  // namespace flexneck::pipeline
