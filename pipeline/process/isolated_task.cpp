// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/isolated_task.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <optional>
#include <unistd.h>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/files_read.h"
#include "geometry/foundation/running_object.h"
#include "pipeline/process/child_main.h"
#include "pipeline/process/child_process.h"
#include "pipeline/process/child_report.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

fs::path command_program() {
  if (runs_as_program()) return "/proc/self/exe";
  const fs::path module = running_object();
  for (fs::path at = module.parent_path();; at = at.parent_path()) {
    for (const char* const name : {"bin/flexneck", "flexneck"})
      if (fs::is_regular_file(at / name)) return at / name;
    if (at == at.root_path()) break;
  }
  throw ComputationError(module.string() +
                         ": the program flexneck, which reads foreign files in a process of its "
                         "own, was not found above it; reinstall flexneck");
}

namespace {

/// Line without the escape sequences that colour a terminal's text.
std::string colourless(const std::string& line) {
  std::string text;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line.compare(k, 2, "\x1b[") == 0) {
      k = std::min(line.find_first_not_of("0123456789;", k + 2), line.size());
    } else {
      text += line[k];
    }
  }
  return text;
}

/// Reason why a child ended that reported none.
std::string death_of(const ChildEnd& end, const ChildLimits& limits) {
  if (end.exit_code == kChildOutOfMemory) {
    const auto in_GB = [](std::uint64_t bytes) {
      return fmt::format("{:.1f} GB", static_cast<double>(bytes) / 1e9);
    };
    return "needs more than " + in_GB(limits.memory_bytes) + " of memory to read it" +
           (limits.later_memory_bytes > 0
                ? ", or more than " + in_GB(limits.later_memory_bytes) + " to process it"
                : "");
  }
  if (end.signal == SIGXCPU)
    return fmt::format("did not finish reading it within {:.0f} s", end.processor_s);
  if (end.signal == SIGALRM)
    return fmt::format("did not finish reading it within {:.0f} s", end.clock_s);
  if (end.signal == SIGKILL) return "was killed while reading it, possibly due to lack of memory";
  if (end.signal != 0) return fmt::format("crashed while reading it ({})", strsignal(end.signal));
  return fmt::format("failed to read it (exit code {})", end.exit_code);
}

/// Reports of a child that decide how the task ends.
struct LastWords {
  std::optional<ChildReport> error;
  std::string chatter;

  void receive(const std::string& line, const ChildLines& lines) {
    const std::optional<ChildReport> report = report_in(line);
    if (!report) {
      const std::string text = colourless(line);
      if (text.empty()) return;
      chatter = text;
      if (lines.chatter) lines.chatter(text);
    } else if (report->kind == ChildReport::Kind::detail) {
      if (lines.detail) lines.detail(report->text);
    } else if (report->kind == ChildReport::Kind::warning) {
      if (lines.warning) lines.warning(report->text);
    } else if (report->kind == ChildReport::Kind::file_read) {
      const std::size_t blank = report->text.find(' ');
      if (blank != std::string::npos)
        note_read(FileRead{report->text.substr(blank + 1), report->text.substr(0, blank)});
    } else {
      error = report;
    }
  }
};

}  // namespace

void run_isolated(const IsolatedTask& task, const std::filesystem::path& temporary,
                  const ChildLines& lines) {
  std::vector<std::string> arguments = child_arguments(task.name, task.limits, getpid());
  arguments.insert(arguments.end(), task.arguments.begin(), task.arguments.end());
  ChildProcess child(task.program, arguments, temporary);
  LastWords last;
  const ChildEnd end = child.wait([&](const std::string& line) { last.receive(line, lines); });
  if (end.signal == 0 && end.exit_code == 0) return;
  if (end.signal == 0 && last.error) {
    if (end.exit_code == kChildInputError) throw InputError(last.error->text);
    if (end.exit_code == kChildComputationError) throw ComputationError(last.error->text);
  }
  throw InputError(
      fmt::format("{}: {} {}{}; {}", task.file.string(), task.library, death_of(end, task.limits),
                  last.chatter.empty() ? "" : ", its last message: " + last.chatter, task.advice));
}

}  // namespace flexneck::pipeline
