// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "multibody/files/history_file.h"
#include "pipeline/cli/commands.h"
#include "pipeline/language/model/model_file.h"

namespace flexneck::pipeline {

/// Runs a model for `simulate`: writes files in input.folder and a summary on the console. @throws
/// as simulate_command().
void simulate_model(const ModelFile& file, const FileInput& input);

struct SimulatedModel {
  multibody::HistoryFile results;  ///< results as `simulate` writes them
  std::string problem;             ///< reason why the run ended early; usually empty
};

/// Runs the model like simulate_model(), and keeps the results in memory.
/// @throws InputError for an error in the model, or if it asks for a Campbell diagram.
SimulatedModel simulated(const ModelFile& file);

}  // namespace flexneck::pipeline
