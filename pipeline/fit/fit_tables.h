// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/fit/fit_job.h"
#include "pipeline/output/result_table.h"

namespace flexneck::pipeline {

/// "fit parameters", whose first note is the verdict; "fit choices", "fit targets", "fit families",
/// "fit directions", "fit correlations", "fit contributions", "fit history", as far as there are
/// such; and "fit failures".
std::vector<ResultTable> fit_tables(const StudyFit& fit, const FitResult& result);

/// The choices that were made with the targets in sight, or that the study states none.
std::string choices_text(const FitSection& section);

/// The parameters of a fit with their intervals of 95 %, in their own units.
struct FittedParameter {
  double value = 0;
  double deviation = 0;  ///< by the linear theory; may be infinite
  double low = 0;        ///< by profile likelihood where there is one; infinite beyond the bounds
  double high = 0;
  bool is_by_profile = false;
};
std::vector<FittedParameter> fitted_parameters(const FitObjective& objective,
                                               const FitResult& result);

}  // namespace flexneck::pipeline
