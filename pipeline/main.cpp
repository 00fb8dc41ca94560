// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "fe_modal/algebra/rank_session.h"
#include "geometry/foundation/atomic_file.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/printable.h"
#include "geometry/foundation/signal_cleanup.h"
#include "pipeline/commands/child_tasks.h"
#include "pipeline/commands/command_line.h"
#include "pipeline/document/shipped_files.h"
#include "pipeline/folder/folder_lock.h"
#include "pipeline/folder/remembered_study.h"
#include "pipeline/study/file_kind.h"
#include "pipeline/sweep/process_rank.h"

namespace {

using namespace flexneck::pipeline;
using flexneck::InputError;
using flexneck::fe_modal::RankOutcome;
using flexneck::fe_modal::Ranks;
using flexneck::fe_modal::RankSession;

constexpr const char* kNoMemory = "the memory that is free does not suffice for this";
constexpr int kVerificationFailed = 1;
constexpr int kUnusableInput = 2;
constexpr int kComputationFailed = 3;

/// The study of a command that goes on in a folder without naming one is the folder's.
StudyChoice choose_study(const CommandLine& line, const Console& console) {
  StudyChoice choice;
  if (!line.files.empty()) choice.study = named_file(line.files.front());
  choice.settings = line.settings;
  // The folder remembers which one; an empty name stands for that of most commands.
  if (line.files.empty() && line.command->built_in != built_in_study)
    choice.study = line.command->built_in();
  if (line.command->begins || !line.files.empty()) return choice;
  const std::optional<StudyChoice> kept = remembered_study(line.folder);
  if (!kept) return choice;
  const StudyChoice given = choice;
  choice = with_settings(*kept, line.settings);
  if (!same(choice, given))
    console.step("Study of " + line.folder.string() + ": " + text_of(choice));
  return choice;
}

Study read_named(const StudyChoice& choice) {
  if (choice.study.empty()) return read_study(built_in_study(), choice.settings);
  try {
    Study study = read_study(choice.study, choice.settings);
    if (!study.structure && !study.matrices) refuse_other_kind(choice.study, FileKind::study);
    return study;
  } catch (const InputError&) {
    refuse_other_kind(choice.study, FileKind::study);
    throw;
  }
}

bool works_on_files(const CommandLine& line) {
  if (line.command->run_on_files == nullptr) return false;
  return line.command->run == nullptr ||
         std::any_of(line.files.begin(), line.files.end(),
                     [](const std::string& file) { return file.ends_with(".h5"); });
}

/// Does the command. @param take_lock is called once its arguments are known to be right
bool do_command(const CommandLine& line, const Console& console, const Ranks* ranks,
                const std::function<void()>& take_lock) {
  const Command& command = *line.command;
  const ResultsFolder folder(line.folder);
  const bool is_first = ranks == nullptr || ranks->is_first();
  if (works_on_files(line)) {
    if (!is_first) return true;
    take_lock();
    return command.run_on_files({{line.files.begin(), line.files.end()},
                                 line.settings,
                                 folder,
                                 console,
                                 line.curves,
                                 line.neck_loads,
                                 line.target,
                                 line.is_binary});
  }
  if (line.files.size() > 1) {
    throw InputError(command.name + ": expected one study, found '" + line.files[1] + "' too");
  }
  const StudyChoice choice = choose_study(line, console);
  const Study study = read_named(choice);
  for (const std::string& warning : study.warnings) console.warning(warning);
  if (ranks != nullptr && (line.show || !command.uses_ranks)) {
    if (!is_first) return true;
    console.step("Only modes are computed on many ranks: '" + command.name + "' runs on the first");
    ranks = nullptr;
  }
  if (ranks == nullptr) {
    take_lock();
  } else {
    ranks->together([&] {
      if (is_first) take_lock();
    });
  }
  if (line.show) return show_command({study, folder, console});
  const bool passed = command.run({.study = study,
                                   .folder = folder,
                                   .console = console,
                                   .target = line.target,
                                   .is_binary = line.is_binary,
                                   .ranks = ranks,
                                   .redo = line.redo,
                                   .sensitivity = line.sensitivity,
                                   .shares = line.shares});
  if (is_first && command.writes_results && command.is_remembered)
    remember_study(line.folder, choice);
  return passed;
}

bool execute(const CommandLine& line, const Console& console, const Ranks* ranks) {
  std::optional<FolderLock> lock;
  const auto take_lock = [&] {
    if (!line.locks()) return;
    lock.emplace(line.folder, line.text,
                 [&](const std::string& warning) { console.warning(warning); });
  };
  const bool passed = do_command(line, console, ranks, take_lock);
  if (lock) flexneck::sync_folder(line.folder);
  return passed;
}

struct Failure {
  int exit_code;
  std::string text;
};

/// Of the exception that is being handled.
Failure failure() {
  try {
    throw;
  } catch (const InputError& error) {
    return {kUnusableInput, error.what()};
  } catch (const std::bad_alloc&) {
    return {kComputationFailed, kNoMemory};
  } catch (const std::exception& error) {
    return {kComputationFailed, error.what()};
  } catch (...) {
    return {kComputationFailed, "failed for an unknown reason"};
  }
}

int exit_code_of(const CommandLine& line) {
  const Console console(line.verbosity());
  try {
    if (line.command == nullptr || !line.answer.empty()) {
      console.result(line.answer);
      return 0;
    }
    return execute(line, console, nullptr) ? 0 : kVerificationFailed;
  } catch (...) {
    const Failure found = failure();
    console.error(found.text);
    return found.exit_code;
  }
}

/// Of a rank among many, of which the first one speaks.
RankOutcome outcome_of(const std::vector<std::string>& words, const Ranks& ranks) {
  try {
    const CommandLine line = parse_command_line(words);
    const Console console(ranks.is_first() ? line.verbosity() : Verbosity::none);
    if (line.command == nullptr || !line.answer.empty()) {
      console.result(line.answer);
      return {};
    }
    return {execute(line, console, &ranks) ? 0 : kVerificationFailed};
  } catch (...) {
    const Failure found = failure();
    return {found.exit_code, found.text};
  }
}

/// Of a sweep on several processes, which are its shards, each by itself; none of other commands.
std::optional<CommandLine> line_of_shard(const std::vector<std::string>& words) {
  const std::optional<Shard> shard = shard_of_process();
  if (!shard) return {};
  try {
    CommandLine line = parse_command_line(words);
    if (line.command == nullptr || !line.command->has_shards || !line.answer.empty()) return {};
    if (!line.shares.shard.empty())
      throw InputError("--shard: expected none under mpirun, whose processes are the parts");
    line.shares.shard = fmt::format("{}/{}", shard->index, shard->count);
    line.shares.threads = std::max(1, line.shares.threads);
    return line;
  } catch (const InputError&) {
    if (shard->index == 1) throw;  // one line is enough
    std::_Exit(kUnusableInput);
  }
}

int run(int argc, char** argv) {
  const std::vector<std::string> words(argv, argv + argc);
  if (!RankSession::is_launched()) return exit_code_of(parse_command_line(words));
  if (const std::optional<CommandLine> line = line_of_shard(words)) {
    forget_other_processes();
    return exit_code_of(*line);
  }
  const RankSession session;
  return session.end(outcome_of(words, session.ranks()), [](const std::string& line) {
    fmt::print(stderr, "flexneck: {}\n", flexneck::printable(line));
  });
}

void tell_without_console(const char* text) noexcept {
  std::fprintf(stderr, "flexneck: %s\n", text);
}

/// Of the exception that is being handled. There may be no memory for more than a line.
int told_without_console() noexcept {
  try {
    const Failure found = failure();
    tell_without_console(flexneck::printable(found.text).c_str());
    return found.exit_code;
  } catch (...) {
    tell_without_console(kNoMemory);
    return kComputationFailed;
  }
}

[[noreturn]] void end_by_library() {
  flexneck::clean_up_now();
  tell_without_console("a library has ended the command; is there memory left?");
  std::_Exit(kComputationFailed);
}

/// Of what is thrown where a library or a thread lets nothing through.
[[noreturn]] void terminate() {
  if (!std::current_exception()) end_by_library();
  const int code = told_without_console();
  flexneck::clean_up_now();
  std::_Exit(code);
}

bool has_ended = false;

/// MPI ends a process in which it cannot start, with the code of a failed verification.
void refuse_end_by_library() {
  if (!has_ended) end_by_library();
}

}  // namespace

int main(int argc, char** argv) {
  keep_standard_streams();
  flexneck::clean_up_on_signals();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is a failure to write, no end
  const std::span<char*> words(argv, static_cast<std::size_t>(argc));
  if (is_child(words)) child_main(words, child_tasks());
  std::set_terminate(terminate);
  std::atexit(refuse_end_by_library);
  int code = kComputationFailed;
  try {
    code = run(argc, argv);
  } catch (...) {
    code = told_without_console();
  }
  has_ended = true;
  return code;
}
