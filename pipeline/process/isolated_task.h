// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "geometry/foundation/progress.h"
#include "pipeline/process/child_limits.h"

namespace flexneck::pipeline {

/// Path of the command `flexneck`, which runs the tasks of child processes: this program, or
/// bin/flexneck or flexneck above the Python module that this code is a part of.
/// @throws ComputationError if there is none above the module.
std::filesystem::path command_program();

/// Receivers of a child's lines; each may be empty.
struct ChildLines {
  Progress detail;   ///< progress
  Progress warning;  ///< warnings for the user
  Progress chatter;  ///< output of libraries, without colours
};

/// A task run in a process of its own, since a foreign library may crash, hang or use up all
/// memory.
struct IsolatedTask {
  std::string name;                    ///< name in the list that the program gives child_main()
  std::vector<std::string> arguments;  ///< arguments of the task
  ChildLimits limits;
  std::filesystem::path file;  ///< file that the library reads, for messages
  std::string library;         ///< name of the library for the user: "gmsh"
  std::string advice;          ///< advice to the user if it fails: "write it anew"
  std::filesystem::path program = command_program();
};

/// Runs a task in a child process: the command, started again.
/// @param temporary  a folder for the files that it leaves behind
/// @throws InputError or ComputationError, as the task does; InputError in one line if the child
/// crashes or exceeds its limits.
void run_isolated(const IsolatedTask& task, const std::filesystem::path& temporary,
                  const ChildLines& lines);

}  // namespace flexneck::pipeline
