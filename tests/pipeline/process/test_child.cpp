// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "pipeline/process/child_main.h"
#include "pipeline/process/child_process.h"
#include "pipeline/process/isolated_task.h"

namespace flexneck::pipeline {
namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::Message;

IsolatedTask task_named(const std::string& name) {
  IsolatedTask task;
  task.name = name;
  task.program = std::string(FLEXNECK_BINARY_DIR) + "/tests/pipeline/process/hostile_child";
  task.file = "bar.msh";
  task.library = "gmsh";
  task.advice = "write it anew";
  task.limits = {.memory_bytes = 200U << 20U, .processor_s = 60, .clock_s = 600};
  return task;
}

/// Message for a task that cannot end well.
std::string refusal(const IsolatedTask& task) {
  const TemporaryFolder folder;
  try {
    run_isolated(task, folder.path(), {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// Returns whether a process runs. One that has ended may still be listed until its parent has
/// waited for it.
bool is_running(const std::string& id) {
  std::ifstream file("/proc/" + id + "/stat");
  std::string text;
  std::getline(file, text);
  return !text.empty() && text.substr(text.rfind(')')).rfind(") Z", 0) != 0;
}

bool ends_soon(const std::string& id) {
  for (int tries = 0; tries < 500 && is_running(id); ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return !is_running(id);
}

}  // namespace

TEST_CASE("a child that crashes, hangs or takes all memory is told in one line") {
  CHECK(refusal(task_named("crash")) ==
        "bar.msh: gmsh crashed while reading it (Aborted), its last message: reading section 7; "
        "write it anew");
  CHECK(refusal(task_named("leave")) ==
        "bar.msh: gmsh failed to read it (exit code 1); write it anew");
  CHECK_THAT(refusal(task_named("allocate")),
             Contains("bar.msh: gmsh needs more than 0.2 GB of memory to read it; write it anew") ||
                 Contains("failed to read it"));  // as the memory of a sanitizer does
  CHECK_THAT(refusal(task_named("recurse")),
             Contains("bar.msh: gmsh crashed while reading it (Segmentation fault)") ||
                 Contains("failed to read it"));
  IsolatedTask busy = task_named("compute");
  busy.limits.processor_s = 1;
  CHECK(refusal(busy) == "bar.msh: gmsh did not finish reading it within 1 s; write it anew");
  IsolatedTask idle = task_named("sleep");
  idle.limits.clock_s = 1;
  CHECK_THAT(refusal(idle), Contains("bar.msh: gmsh did not finish reading it within "));
}

TEST_CASE("once a child has read a file it may take more memory, up to another limit") {
  const TemporaryFolder folder;
  IsolatedTask task = task_named("allocate later");
  task.limits.later_memory_bytes = 400U << 20U;
  CHECK_NOTHROW(run_isolated(task, folder.path(), {}));
  task.limits.later_memory_bytes = 250U << 20U;
  CHECK_THAT(
      refusal(task),
      Contains("needs more than 0.2 GB of memory to read it, or more than 0.3 GB to process it") ||
          Contains("failed to read it"));
}

TEST_CASE("once a child has read a file its time begins anew, but has an end") {
  IsolatedTask task = task_named("compute later");
  task.limits.processor_s = 1;
  CHECK(refusal(task) == "bar.msh: gmsh did not finish reading it within 2 s; write it anew");
}

TEST_CASE("what a child refuses is refused in its words, and its end does not count") {
  const TemporaryFolder folder;
  CHECK(refusal(task_named("refuse")) == "bar.msh: it has no volume");
  CHECK_THROWS_MATCHES(run_isolated(task_named("fail"), folder.path(), {}), ComputationError,
                       Message("the disk is full"));
  CHECK_NOTHROW(run_isolated(task_named("crash at exit"), folder.path(), {}));
  IsolatedTask missing = task_named("tell");
  missing.program = folder / "none";
  CHECK_THROWS_WITH(run_isolated(missing, folder.path(), {}),
                    Contains("none: cannot be started as a child process: No such file"));
  CHECK_THROWS_AS(run_isolated(missing, folder.path(), {}), ComputationError);
}

TEST_CASE("a child has its arguments, a folder, no open files, and knows no ranks") {
  const TemporaryFolder folder;
  const std::ifstream open_here("/proc/self/stat");
  setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
  setenv("PMIX_RANK", "1", 1);
  IsolatedTask task = task_named("tell");
  task.arguments = {"two words", "--version"};
  std::vector<std::string> details;
  std::vector<std::string> warnings;
  std::vector<std::string> chatter;
  const auto into = [](std::vector<std::string>& list) {
    return [&list](const std::string& line) { list.push_back(line); };
  };
  run_isolated(task, folder.path(), {into(details), into(warnings), into(chatter)});
  unsetenv("OMPI_COMM_WORLD_SIZE");
  unsetenv("PMIX_RANK");
  const auto count = [&](const std::string& beginning) {
    return std::count_if(details.begin(), details.end(),
                         [&](const std::string& line) { return line.starts_with(beginning); });
  };
  CHECK(count("argument two words") == 1);
  CHECK(count("argument --version") == 1);
  CHECK(count("OMPI_") + count("PMIX_") == 0);
  CHECK(count("PATH=") == 1);
  CHECK(count("TMPDIR=") == 1);
  CHECK(count("TMPDIR=" + folder.path().string()) == 1);
  CHECK(count("file ") == 4);  // the three of every process, and the folder that it lists
  CHECK(warnings == std::vector<std::string>{"a part is left out"});
  CHECK(chatter == std::vector<std::string>{"a line without an end"});
}

TEST_CASE("no child outlives its parent, and what a child leaves behind is not waited for") {
  const TemporaryFolder folder;
  SECTION("a parent that is killed takes its child along") {
    const IsolatedTask task = task_named("have child");
    std::string child;
    CHECK_THROWS_AS(
        [&] {
          ChildProcess parent(task.program, child_arguments(task.name, task.limits, getpid()),
                              folder.path());
          parent.wait([&](const std::string& line) {
            if (line.size() < 3) return;
            child = line.substr(2);  // after the mark of a report
            CHECK(is_running(child));
            throw InputError("the user has had enough");
          });
        }(),
        InputError);
    REQUIRE_FALSE(child.empty());
    CHECK(ends_soon(child));
  }
  SECTION("a program left behind that holds the output does not matter") {
    const auto start = std::chrono::steady_clock::now();
    ChildProcess shell("/bin/sh", {"-c", "sleep 60 & echo $!; exit 7"}, folder.path());
    std::string left;
    const ChildEnd end = shell.wait([&](const std::string& line) { left = line; });
    CHECK(end.exit_code == 7);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(30));
    CHECK(is_running(left));
    kill(static_cast<pid_t>(std::stol(left)), SIGKILL);
  }
}

}  // namespace flexneck::pipeline
