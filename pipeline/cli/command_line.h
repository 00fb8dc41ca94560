// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/cli/commands.h"

namespace flexneck::pipeline {

inline constexpr const char* kPurpose = "from the geometry of a dummy's neck to its motion";
inline constexpr const char* kUsage = "flexneck COMMAND [FILE ...] [OPTIONS]";
inline constexpr const char* kExitCodes =
    "Exit codes: 0 done, 1 a verification failed, 2 unusable input, 3 a computation failed.";

/// An option as the help of its command shows it.
struct OptionText {
  std::vector<std::string> names;  ///< "-o", "--out"
  std::string label;               ///< name of its value; empty for a flag
  std::string help;
};

/// All options of a command, in the order of its help.
std::vector<OptionText> options_of(const Command& command);

/// A parsed command line: the command, and the values of its options.
struct CommandLine {
  std::string text;    ///< the command line as given
  std::string answer;  ///< text to print instead of running a command: the help, the version, …
  const Command* command = nullptr;
  std::vector<std::string> files;
  std::filesystem::path folder = "out";
  std::vector<std::string> settings;
  bool is_quiet = false;
  bool is_verbose = false;
  bool show = false;
  bool redo = false;
  bool keep = false;
  bool sensitivity = false;
  std::filesystem::path target;
  bool is_binary = false;
  CurveChoice curves;
  NeckLoadChoice neck_loads;
  WorkShares shares;

  /// True if the command writes to the folder of results.
  bool writes() const { return command->writes_results && !show && !folder.empty(); }
  bool locks() const { return writes() && command->locks; }
  Verbosity verbosity() const {
    return is_quiet ? Verbosity::quiet : is_verbose ? Verbosity::verbose : Verbosity::normal;
  }
};

/// Parses a command line. The command comes first; without one it is `run`.
/// @param words the arguments of main, the program's name included
/// @throws InputError for a command that does not exist, or an option that the command has not.
CommandLine parse_command_line(const std::vector<std::string>& words);

}  // namespace flexneck::pipeline
