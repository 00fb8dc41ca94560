// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "multibody/history_file.h"

namespace flexneck::pipeline {

/// Writes channels as comma-separated values: a line with names and units, then one line per time.
/// Numbers have as many digits as it takes to read them back exactly.
/// @param first  name and unit of the first column
/// @throws InputError if the file cannot be written; nothing is left then.
void write_csv(const std::filesystem::path& path, const Eigen::VectorXd& time_s,
               const std::vector<multibody::Channel>& channels,
               const std::string& first = "time [s]");

}  // namespace flexneck::pipeline
