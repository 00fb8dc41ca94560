// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/parameter_studies/fit/fit_job.h"

namespace flexneck::pipeline {

/// Reasons why a fit is not unique, a clause each; empty if there are none:
///  - several families are as good (Family::is_as_good);
///  - a direction of the parameters is not determined by any target (kLeastSingularValue);
///  - a profile does not rise by 3.84 within the bounds, or found a better fit;
///  - a parameter is at its bound.
std::vector<std::string> against_uniqueness(const FitObjective& objective, const FitResult& result);

/// First line about a fit: whether it is unique, and whether it meets its targets.
std::string verdict_of_fit(const FitObjective& objective, const FitResult& result);

}  // namespace flexneck::pipeline
