// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "pipeline/report/results.h"

namespace flexneck::pipeline {

/// Writes one page with everything that the results hold: it needs no network and no other file.
/// The paper's figures stand beside it, too, in the folder figures. The same results give the same
/// bytes.
/// @throws InputError if a package that it needs is not installed, or the file cannot be written.
void write_report(const std::filesystem::path& path, const Results& results, const Study& study);

}  // namespace flexneck::pipeline
