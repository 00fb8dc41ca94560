// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "pipeline/run/command_input.h"

namespace flexneck::pipeline {

/// Options that only some commands have.
enum class CommandOption {
  folder,
  optional_folder,
  settings,
  mesh_settings,
  modes_settings,
  cases,
  sensitivity,
  redo,
  keep,
  show,
  target,
  curves,
  neck_loads,
  shards,
  threads
};

/// Name and help of a command's file arguments.
struct FileArguments {
  std::string label;
  std::string help;
};

/// A command returns true unless a verification failed; everything else is an exception.
struct Command {
  std::string name;
  std::string help;
  FileArguments files;
  std::vector<CommandOption> options;
  bool (*run)(const CommandInput&);  ///< null if the command works on files
  /// Null if the command works on a study. A command with both (export) calls this one if
  /// exports_file() is true.
  bool (*run_on_files)(const FileInput&) = nullptr;
  /// Path of the study to take if none is named.
  std::filesystem::path (*built_in)() = built_in_study;
  bool writes_results = true;  ///< the command writes to the folder of results
  bool begins = false;         ///< the command starts a folder from a named study
  bool locks = true;           ///< the folder is locked throughout; otherwise the command locks it
  bool has_shards = false;     ///< each process of mpirun computes a shard
  bool uses_ranks = false;     ///< the processes of mpirun work together
  bool is_remembered = true;   ///< the folder remembers the study, if it is told to or knows none
};

/// All commands, in the order of --help.
const std::vector<Command>& commands();

/// Warns before a stage run by itself replaces a file by one made from other values.
void warn_of_replaced(const CommandInput& input, const std::filesystem::path& file,
                      const FileFormat& format, const Provenance& now);

bool run_command(const CommandInput& input);
/// Runs run_command() for a study with tests of regulations and prints all figures of the tests.
/// @throws InputError for a study without one.
bool qualify_command(const CommandInput& input);
bool mesh_command(const CommandInput& input);
/// Prints, for `mesh --dry-run`, the neck's dimensions, the values that follow from them, and a
/// drawing; meshes nothing.
bool show_command(const CommandInput& input);
bool modes_command(const CommandInput& input);
/// Solves the linear static step under the study's [[load]]; writes stress.h5, and stress.xdmf for
/// ParaView.
bool stress_command(const CommandInput& input);
bool export_command(const CommandInput& input);
bool pictures_command(const CommandInput& input);
bool static_command(const CommandInput& input);
/// Runs all cases of the pendulum and writes their tables.
bool pendulum_command(const CommandInput& input);
bool verify_command(const CommandInput& input);
bool report_command(const CommandInput& input);
bool study_command(const CommandInput& input);
/// Computes the rows of [sweep] and, once all exist, writes sweep.csv, sweep.h5 and sweep.json.
bool sweep_command(const CommandInput& input);
/// Finds the free parameters of [fit] that bring the results to its targets, and how well the
/// targets determine them; writes fit.json and fitted.toml.
bool fit_command(const CommandInput& input);

/// Runs a model file (manual/reference/model_files.md): writes <its name>.h5 and <its name>.csv in
/// the folder, and a summary on the console.
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
/// @throws InputError for curves that cannot be read or rated (pipeline/laboratory/rating/).
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
