// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/parameter_studies/fit/fit_job.h"

namespace flexneck::pipeline {

/// Text of a study file that includes the fitted one and sets the fitted values, each of origin
/// "calibrated" with its interval in its note, and the other settings of the command line. If the
/// fit has changed the neck, the file states what the neck is fitted to (NeckSection::fitted_to).
/// Comments at its head give the verdict, the program, the inputs and the choices made with
/// knowledge of the targets.
/// @param folder  the folder that the file will be in
std::string fitted_study(StudyFit& fit, const FitResult& result,
                         const std::filesystem::path& folder);

}  // namespace flexneck::pipeline
