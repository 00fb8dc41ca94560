// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/foundation/progress.h"
#include "pipeline/isolation/child_limits.h"
#include "pipeline/isolation/command_program.h"

namespace flexneck::pipeline {

/// Where the lines of a child go; each may be empty.
struct ChildLines {
  Progress detail;   ///< what it does
  Progress warning;  ///< for the user
  Progress chatter;  ///< what libraries print, without its colours
};

/// A task that a process of its own does, since a library of others may crash, hang or take all
/// memory over it.
struct IsolatedTask {
  std::string name;                    ///< in the list of child_tasks.h
  std::vector<std::string> arguments;  ///< of the task
  ChildLimits limits;
  std::filesystem::path file;  ///< what the library reads, for messages
  std::string library;         ///< whose name the user knows: "gmsh"
  std::string advice;          ///< what to do if it cannot: "write it anew"
  std::filesystem::path program = command_program();
};

/// Runs a task in a child process: the command, started again.
/// @param temporary  a folder for what it leaves behind
/// @throws InputError or ComputationError, as the task does; InputError in one line if the child
/// crashes or exceeds its limits.
void run_isolated(const IsolatedTask& task, const std::filesystem::path& temporary,
                  const ChildLines& lines);

}  // namespace flexneck::pipeline
