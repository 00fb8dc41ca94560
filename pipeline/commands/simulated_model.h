// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "multibody/files/history_file.h"
#include "pipeline/commands/file_commands.h"
#include "pipeline/model/model_file.h"

namespace flexneck::pipeline {

/// What `simulate` does with a model that has been read: files in input.folder, a summary on the
/// console. @throws as simulate_command().
void simulate_model(const ModelFile& file, const FileInput& input);

struct SimulatedModel {
  multibody::HistoryFile results;  ///< as `simulate` writes them
  std::string problem;             ///< why the run ended early; empty as a rule
};

/// The same run, kept in memory.
/// @throws InputError for what is wrong with the model, and for one that asks for a Campbell
/// diagram.
SimulatedModel simulated(const ModelFile& file);

}  // namespace flexneck::pipeline
