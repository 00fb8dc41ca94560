// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline/process/isolated_task.h"

namespace flexneck::pipeline {

/// A task of a child process. It throws its errors.
struct ChildTask {
  std::string name;
  void (*run)(const std::vector<std::string>& arguments, const ChildLines& lines);
};

/// First arguments of this program as a child; those of the task follow.
std::vector<std::string> child_arguments(const std::string& task, const ChildLimits& limits,
                                         pid_t parent);

/// Returns whether the program's arguments, including its name, are those of a child.
bool is_child(std::span<char*> arguments);

/// Runs the task that the arguments name within the limits that they give, and ends the process, so
/// that errors of libraries at its end are ignored.
[[noreturn]] void child_main(std::span<char*> arguments, const std::vector<ChildTask>& tasks);

}  // namespace flexneck::pipeline
