// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/console/console.h"
#include "pipeline/folder/results_folder.h"

namespace flexneck::pipeline {

/// Which curves are rated, as given: empty where nothing is.
struct CurveChoice {
  std::string channel;            ///< column of both files
  std::string reference_channel;  ///< of the reference, where it has another name
  std::string unit;               ///< of files that name none
  std::string from, to;           ///< times with their units
};

/// Which columns are loads of the neck.
struct NeckLoadChoice {
  std::string force, moment;  ///< along z and about y
  std::string shear;          ///< along x, if the moment is that about a load cell; else empty
  std::string dummy = "50th-male";
};

/// What the commands get that work on files they are given instead of a study.
struct FileInput {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> settings;
  const ResultsFolder& folder;  ///< of an empty path if nothing is to be written
  const Console& console;
  CurveChoice curves = {};
  NeckLoadChoice neck_loads = {};
  std::filesystem::path target = {};  ///< of export
  bool is_binary = false;             ///< likewise
};

/// Runs a model file (pipeline/models/README.md): <its name>.h5 and <its name>.csv in the folder, a
/// summary on the console.
/// @throws InputError for what is wrong with the model; nothing is written then.
/// @throws ComputationError if the run ends early; what was computed is written, marked incomplete.
bool simulate_command(const FileInput& input);

/// Describes files of ours, and what folders hold: what is in them and what they were made from.
/// @throws InputError for a file of another kind.
bool info_command(const FileInput& input);

/// Several folders of results side by side: comparison.html and comparison.json.
/// @throws InputError for less than two, or one without results.
bool compare_command(const FileInput& input);

/// Rates a curve against a reference by ISO/TS 18571 and CORA; writes rating.json if there is a
/// folder.
/// @throws InputError for curves that cannot be read or rated (pipeline/rating/).
bool rate_command(const FileInput& input);

/// Nij of a neck's loads; writes nij.json if there is a folder.
/// @throws InputError for loads that cannot be read or filtered.
bool nij_command(const FileInput& input);

/// Writes the run or the modal body of a file in another format.
/// @throws InputError for a format that is none of a file, or what it cannot take.
bool export_file_command(const FileInput& input);

/// What files that users write may say: the keys of studies, models and tables of references.
/// @throws InputError for a name that is none of a kind of file, a table or a key in it.
bool keys_command(const FileInput& input);

}  // namespace flexneck::pipeline
