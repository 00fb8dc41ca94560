// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/parameter_studies/fit/fit_job.h"

namespace flexneck::pipeline {

/// Draws into a folder, by gnuplot: fit-targets.svg, the residuals; fit-profiles.svg, chi-squared
/// over each parameter; fit-history.svg, the points of the prior and those that meet all targets,
/// for each pair of parameters; fit-curve-<target>.svg, a curve before and after the fit and its
/// target.
/// @return the names of the pictures
/// @throws as run_gnuplot() does.
std::vector<std::string> draw_fit(StudyFit& fit, const FitResult& result,
                                  const std::filesystem::path& folder);

}  // namespace flexneck::pipeline
