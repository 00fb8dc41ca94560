// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/console/console.h"
#include "pipeline/folder/results_folder.h"

namespace flexneck::pipeline {

/// What the commands get that work on files they are given instead of a study.
struct FileInput {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> settings;
  const ResultsFolder& folder;
  const Console& console;
};

/// Runs a model file (pipeline/models/README.md): <its name>.h5 and <its name>.csv in the folder, a
/// summary on the console.
/// @throws InputError for what is wrong with the model; nothing is written then.
/// @throws ComputationError if the run ends early; what was computed is written, marked incomplete.
bool simulate_command(const FileInput& input);

/// Describes files of ours: what is in them and what they were made from.
/// @throws InputError for a file of another kind.
bool info_command(const FileInput& input);

/// Several folders of results side by side: comparison.html and comparison.json.
/// @throws InputError for less than two, or one without results.
bool compare_command(const FileInput& input);

/// What files that users write may say: the keys of studies, models and tables of references.
/// @throws InputError for a name that is none of a kind of file, a table or a key in it.
bool keys_command(const FileInput& input);

}  // namespace flexneck::pipeline
