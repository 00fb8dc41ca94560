// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// Text such as "All 6 figures that are judged agree. …".
std::string verification_summary(const VerificationTable& table);

/// HTML of the page's first screen beside the moving neck: the computations, and each verdict.
std::string summary_html(const Results& results, const Study& study);

}  // namespace flexneck::pipeline
