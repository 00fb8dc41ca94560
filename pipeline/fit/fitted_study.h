// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/fit/fit_job.h"

namespace flexneck::pipeline {

/// A study file that includes the one that was fitted and sets the fitted values, each of origin
/// "calibrated" with its interval in its note, and what the command line has set besides. Where the
/// fit has changed the neck, it states what that is fitted to (NeckSection::fitted_to). Comments
/// at its head tell the verdict, the program, the inputs and what was chosen with the targets in
/// sight.
/// @param folder  that it will stand in
std::string fitted_study(StudyFit& fit, const FitResult& result,
                         const std::filesystem::path& folder);

}  // namespace flexneck::pipeline
