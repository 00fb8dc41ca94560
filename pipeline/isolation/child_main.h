// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "pipeline/isolation/isolated_task.h"

namespace flexneck::pipeline {

/// What a child process can do. It throws what is wrong.
struct ChildTask {
  std::string name;
  void (*run)(const std::vector<std::string>& arguments, const ChildLines& lines);
};

/// First arguments of this program as a child; those of the task follow.
std::vector<std::string> child_arguments(const std::string& task, const ChildLimits& limits,
                                         pid_t parent);

/// Whether the arguments of the program, its name among them, are those of a child.
bool is_child(std::span<char*> arguments);

/// Does the task that the arguments name within the limits that they give, and ends the process:
/// what libraries do at its end does not count.
[[noreturn]] void child_main(std::span<char*> arguments, const std::vector<ChildTask>& tasks);

}  // namespace flexneck::pipeline
