// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/console/console.h"
#include "pipeline/folder/results_folder.h"

namespace flexneck::pipeline {

/// The curves to rate, as given by the user; empty where nothing is given.
struct CurveChoice {
  std::string channel;            ///< column of both files
  std::string reference_channel;  ///< column of the reference, if it has another name
  std::string unit;               ///< unit for files that name none
  std::string from, to;           ///< times with their units
};

/// The columns with the loads of the neck.
struct NeckLoadChoice {
  std::string force, moment;  ///< along z and about y
  std::string shear;          ///< along x, if the moment is about a load cell; else empty
  std::string dummy = "50th-male";
};

/// Input of the commands that work on given files instead of a study.
struct FileInput {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> settings;
  const ResultsFolder& folder;  ///< its path is empty if nothing is to be written
  const Console& console;
  CurveChoice curves = {};
  NeckLoadChoice neck_loads = {};
  std::filesystem::path target = {};  ///< file that `export` writes
  bool is_binary = false;             ///< `export` writes the binary variant
};

/// Runs a model file (pipeline/models/README.md): writes <its name>.h5 and <its name>.csv in the
/// folder, and a summary on the console.
/// @throws InputError for an error in the model; nothing is written then.
/// @throws ComputationError if the run ends early; the results so far are written, marked
/// incomplete.
bool simulate_command(const FileInput& input);

/// Describes flexneck's files and folders: their contents and the inputs that they were made from.
/// @throws InputError for a file of another kind.
bool info_command(const FileInput& input);

/// Compares several folders of results side by side: comparison.html and comparison.json.
/// @throws InputError for fewer than two folders, or one without results.
bool compare_command(const FileInput& input);

/// Rates a curve against a reference by ISO/TS 18571 and CORA; writes rating.json if there is a
/// folder.
/// @throws InputError for curves that cannot be read or rated (pipeline/rating/).
bool rate_command(const FileInput& input);

/// Computes Nij from a neck's loads; writes nij.json if there is a folder.
/// @throws InputError for loads that cannot be read or filtered.
bool nij_command(const FileInput& input);

/// Writes the run or the modal body of a file in another format.
/// @throws InputError for a format that no file can be exported to, or data that the format cannot
/// take.
bool export_file_command(const FileInput& input);

/// Prints the keys that users' files may contain: studies, models and tables of references.
/// @throws InputError for an unknown kind of file, table or key.
bool keys_command(const FileInput& input);

}  // namespace flexneck::pipeline
