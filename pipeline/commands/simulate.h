// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/console.h"
#include "pipeline/results_folder.h"

namespace flexneck::pipeline {

struct SimulateInput {
  std::filesystem::path model;  ///< a model file (pipeline/models/README.md)
  std::vector<std::string> settings;
  const ResultsFolder& folder;
  const Console& console;
};

/// Runs a model file: <its name>.h5 and <its name>.csv in the folder, a summary on the console.
/// @throws InputError for what is wrong with the model; nothing is written then.
/// @throws ComputationError if the run ends early; what was computed is written, marked incomplete.
bool simulate_command(const SimulateInput& input);

}  // namespace flexneck::pipeline
