// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "pipeline/results/report/results.h"

namespace flexneck::pipeline {

/// Writes one page with all results: it needs no network and no other file. The paper's figures are
/// also written to the folder figures beside it. The same results give the same bytes.
/// @throws InputError if a required package is not installed, or the file cannot be written.
void write_report(const std::filesystem::path& path, const Results& results, const Study& study);

}  // namespace flexneck::pipeline
