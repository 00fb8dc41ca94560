// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/parameter_studies/fit/fit_job.h"
#include "pipeline/process/result_table.h"

namespace flexneck::pipeline {

/// Tables "fit parameters", whose first note is the verdict; "fit choices", "fit targets", "fit
/// families", "fit directions", "fit correlations", "fit contributions", "fit history", as far as
/// they apply; and "fit failures".
std::vector<ResultTable> fit_tables(const StudyFit& fit, const FitResult& result);

/// Text of the choices made with knowledge of the targets, or that the study states none.
std::string choices_text(const FitSection& section);

/// Parameter of a fit with its 95 % interval, in its own unit.
struct FittedParameter {
  double value = 0;
  double deviation = 0;  ///< deviation by the linear theory; may be infinite
  double low = 0;        ///< bound by profile likelihood if computed; infinite beyond the bounds
  double high = 0;
  bool is_by_profile = false;
};
std::vector<FittedParameter> fitted_parameters(const FitObjective& objective,
                                               const FitResult& result);

}  // namespace flexneck::pipeline
