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

/// How the work is shared out; empty and 0 where nothing is said.
struct WorkShares {
  std::string shard;  ///< of a sweep's rows: "2/8"
  int threads = 0;
};

/// What every command gets. Of a command that uses ranks, all call it; the first one alone writes
/// files, and its console is the only one that speaks.
struct CommandInput {
  const Study& study;
  const ResultsFolder& folder;
  const Console& console;
  std::filesystem::path target = {};  ///< of export
  bool is_binary = false;             ///< likewise
  fe_modal::Ranks ranks = {};         ///< that mpirun has started
  bool redo = false;                  ///< of run: even what has not changed
  bool is_run = false;                ///< all that follows is made anew, too
  bool sensitivity = false;           ///< of modes: their derivatives, too
  WorkShares shares = {};
};

/// Whether this process writes files.
inline bool writes(const CommandInput& input) { return input.ranks.is_first(); }

/// As many as are asked for, otherwise as there are processors.
inline unsigned threads_of(const CommandInput& input) {
  if (input.shares.threads > 0) return static_cast<unsigned>(input.shares.threads);
  return std::max(1U, std::thread::hardware_concurrency());
}

/// Options that some commands have and others have not.
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

/// What a command's files are.
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
  bool (*run)(const CommandInput&);  ///< null if it works on files
  /// Null if it works on a study; with both it is of the files of exports_file() (export).
  bool (*run_on_files)(const FileInput&) = nullptr;
  /// The study where none is named.
  std::filesystem::path (*built_in)() = built_in_study;
  bool writes_results = true;  ///< into the folder of results
  bool begins = false;         ///< makes a folder from a study that is named
  bool locks = true;           ///< the folder, all the time; otherwise it does so itself
  bool has_shards = false;     ///< which processes of mpirun are
  bool uses_ranks = false;     ///< processes of mpirun work together
  bool is_remembered = true;   ///< the folder remembers its study, if it is told to or knows none
};

/// All commands, in the order of --help; the first one is that of a line without a command.
const std::vector<Command>& commands();

/// Of a stage by itself, before it replaces a file by one that is made from other values.
void warn_of_replaced(const CommandInput& input, const std::filesystem::path& file,
                      const FileFormat& format, const Provenance& now);

bool run_command(const CommandInput& input);
/// run_command() of a study with tests of regulations, and each of their figures.
/// @throws InputError for a study without one.
bool qualify_command(const CommandInput& input);
bool mesh_command(const CommandInput& input);
/// Of `mesh --dry-run`: the neck's dimensions, what follows from them, and a drawing; meshes
/// nothing.
bool show_command(const CommandInput& input);
bool modes_command(const CommandInput& input);
/// The linear static step under the study's [[load]]: stress.h5, and stress.xdmf for ParaView.
bool stress_command(const CommandInput& input);
bool export_command(const CommandInput& input);
bool pictures_command(const CommandInput& input);
bool static_command(const CommandInput& input);
/// All cases, and their tables.
bool pendulum_command(const CommandInput& input);
bool verify_command(const CommandInput& input);
bool report_command(const CommandInput& input);
bool study_command(const CommandInput& input);
/// The rows of [sweep] and, once all are there, sweep.csv, sweep.h5 and sweep.json.
bool sweep_command(const CommandInput& input);
/// The free parameters of [fit] that bring the results to its targets, and how far these fix them:
/// fit.json, fitted.toml.
bool fit_command(const CommandInput& input);

}  // namespace flexneck::pipeline
