// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "fe_modal/algebra/ranks.h"
#include "pipeline/commands/file_commands.h"
#include "pipeline/console/console.h"
#include "pipeline/folder/results_folder.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// Distribution of the work; empty and 0 where the user sets nothing.
struct WorkShares {
  std::string shard;  ///< part of a sweep's rows: "2/8"
  int threads = 0;
};

/// Input of every command that works on a study. All ranks call a command that uses ranks; only the
/// first one writes files and prints to its console.
struct CommandInput {
  const Study& study;
  const ResultsFolder& folder;
  const Console& console;
  std::filesystem::path target = {};  ///< file that `export` writes
  bool is_binary = false;             ///< `export` writes the binary variant
  fe_modal::Ranks ranks = {};         ///< the ranks that mpirun has started
  bool redo = false;                  ///< `run` also recomputes stages that have not changed
  bool is_run = false;                ///< called by `run`, which recomputes all later stages
  bool sensitivity = false;           ///< `modes` also computes its derivatives
  WorkShares shares = {};
};

/// True if this process writes files.
inline bool writes(const CommandInput& input) { return input.ranks.is_first(); }

/// Number of threads asked for, by default the number of processors.
inline unsigned threads_of(const CommandInput& input) {
  if (input.shares.threads > 0) return static_cast<unsigned>(input.shares.threads);
  return std::max(1U, std::thread::hardware_concurrency());
}

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

/// All commands, in the order of --help; the first one is run by a line without a command.
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

}  // namespace flexneck::pipeline
