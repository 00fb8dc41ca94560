// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/child_main.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <new>

#include "geometry/foundation/error.h"
#include "geometry/foundation/files_read.h"
#include "geometry/foundation/names.h"
#include "pipeline/process/child_report.h"

namespace flexneck::pipeline {

namespace {

constexpr const char* kChild = "--isolated";
constexpr std::size_t kOwnArguments = 7;

void report(ChildReport::Kind kind, const std::string& text) {
  std::cout << line_of({kind, text}) << std::flush;
}

Progress reporter(ChildReport::Kind kind) {
  return [kind](const std::string& text) { report(kind, text); };
}

void run_task(std::span<char*> arguments, const std::vector<ChildTask>& tasks) {
  if (arguments.size() < 1 + kOwnArguments) {
    throw InputError(std::string(kChild) + " is reserved for internal use by flexneck");
  }
  const auto number = [&](std::size_t place) {
    return std::strtoull(arguments[place], nullptr, 10);
  };
  limit_this_process({.memory_bytes = number(4),
                      .processor_s = static_cast<unsigned>(number(5)),
                      .clock_s = static_cast<unsigned>(number(6)),
                      .later_memory_bytes = number(7)},
                     static_cast<pid_t>(number(3)));
  const std::span<char*> rest = arguments.subspan(1 + kOwnArguments);
  tasks[find_name(names_of(tasks), arguments[2], "task")].run(
      {rest.begin(), rest.end()}, {.detail = reporter(ChildReport::Kind::detail),
                                   .warning = reporter(ChildReport::Kind::warning),
                                   .chatter = {}});
}

int exit_code_of(std::span<char*> arguments, const std::vector<ChildTask>& tasks) {
  try {
    run_task(arguments, tasks);
    return EXIT_SUCCESS;
  } catch (const InputError& error) {
    report(ChildReport::Kind::input_error, error.what());
    return kChildInputError;
  } catch (const std::bad_alloc&) {
    return kChildOutOfMemory;
  } catch (const std::exception& error) {
    report(ChildReport::Kind::computation_error, error.what());
    return kChildComputationError;
  } catch (...) {
    return EXIT_FAILURE;  // a library's own kind of exception
  }
}

}  // namespace

std::vector<std::string> child_arguments(const std::string& task, const ChildLimits& limits,
                                         pid_t parent) {
  return {kChild,
          task,
          std::to_string(parent),
          std::to_string(limits.memory_bytes),
          std::to_string(limits.processor_s),
          std::to_string(limits.clock_s),
          std::to_string(limits.later_memory_bytes)};
}

bool is_child(std::span<char*> arguments) {
  return arguments.size() > 1 && std::string_view(arguments[1]) == kChild;
}

void child_main(std::span<char*> arguments, const std::vector<ChildTask>& tasks) {
  const FilesRead reads;
  const int code = exit_code_of(arguments, tasks);
  // Reported whether the task has succeeded or not: the parent depends on these files.
  for (const FileRead& file : reads.files())
    report(ChildReport::Kind::file_read, file.hash + " " + file.path);
  std::cout.flush();
  std::fflush(nullptr);
  std::_Exit(code);
}

}  // namespace flexneck::pipeline
