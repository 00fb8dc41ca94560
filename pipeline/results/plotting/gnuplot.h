// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace flexneck::pipeline {

/// Runs gnuplot on a script in a folder, from which it reads and into which it writes.
/// @throws InputError with the package's name if gnuplot is not installed.
/// @throws ComputationError with its first complaint if it fails.
void run_gnuplot(const std::filesystem::path& folder, const std::string& script_name);

}  // namespace flexneck::pipeline
