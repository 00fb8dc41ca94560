// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "fe_modal/algebra/rank_session.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/path_error.h"
#include "geometry/foundation/printable.h"
#include "geometry/foundation/signal_cleanup.h"
#include "pipeline/cli/command_line.h"
#include "pipeline/cli/execute.h"
#include "pipeline/parameter_studies/sweep/process_rank.h"
#include "pipeline/process/child_main.h"
#include "pipeline/process/result_files.h"

namespace {

using namespace flexneck::pipeline;
using flexneck::InputError;
using flexneck::fe_modal::RankOutcome;
using flexneck::fe_modal::Ranks;
using flexneck::fe_modal::RankSession;

/// Message if there is not enough memory to compose another.
constexpr const char* kNoMemory =
    "out of memory; provide more memory, or use a coarser mesh or a smaller model";
constexpr int kVerificationFailed = 1;
constexpr int kUnusableInput = 2;
constexpr int kComputationFailed = 3;

struct Failure {
  int exit_code;
  std::string text;
};

std::string doing_of(const CommandLine& line) {
  return line.command == nullptr ? "reading the command line"
                                 : "running 'flexneck " + line.command->name + "'";
}

/// Exit code and message for the exception being handled.
/// @param doing activity that ran out of memory, for that message
Failure failure(const std::string& doing) {
  try {
    throw;
  } catch (const InputError& error) {
    return {kUnusableInput, error.what()};
  } catch (const std::bad_alloc&) {
    constexpr const char* kAdvice = "provide more memory, or use a coarser mesh or a smaller model";
    return {kComputationFailed, flexneck::out_of_memory(doing, kAdvice).what()};
  } catch (const std::filesystem::filesystem_error& error) {
    return {flexneck::is_of_path(error) ? kUnusableInput : kComputationFailed,
            flexneck::text_of(error)};
  } catch (const std::exception& error) {
    return {kComputationFailed, error.what()};
  } catch (...) {
    return {kComputationFailed, "failed with an unknown error"};
  }
}

int exit_code_of(const CommandLine& line) {
  const Console console(line.verbosity());
  try {
    if (line.command == nullptr || !line.answer.empty()) {
      console.result(line.answer);
      return 0;
    }
    return execute(line, console) ? 0 : kVerificationFailed;
  } catch (...) {
    const Failure found = failure(doing_of(line));
    console.error(found.text);
    return found.exit_code;
  }
}

/// Fails if the ranks were given different commands.
void require_same_command(const std::vector<std::string>& words, const Ranks& ranks) {
  std::string text;
  for (std::size_t k = 1; k < words.size(); ++k) text += (k > 1 ? " " : "") + words[k];
  const std::uint64_t hash = std::hash<std::string>()(text);
  const std::uint64_t of_first = ranks.of_first(hash);
  ranks.together([&] {
    if (hash != of_first)
      throw InputError(
          "rank " + std::to_string(ranks.own()) + " was given the command line '" + text +
          "', which differs from that of rank 0; start all ranks with the same command line");
  });
}

/// Runs the command on one rank of several, of which only the first prints.
RankOutcome outcome_of(const std::vector<std::string>& words, const Ranks& ranks) {
  try {
    require_same_command(words, ranks);
    const CommandLine line = parse_command_line(words);
    const Console console(ranks.is_first() ? line.verbosity() : Verbosity::none);
    if (line.command == nullptr || !line.answer.empty()) {
      console.result(line.answer);
      return {};
    }
    return {execute(line, console, ranks) ? 0 : kVerificationFailed};
  } catch (...) {
    const Failure found = failure("running a rank");
    return {found.exit_code, found.text};
  }
}

/// The parsed command line; none if it is refused.
std::optional<CommandLine> parsed(const std::vector<std::string>& words) {
  try {
    return parse_command_line(words);
  } catch (const InputError&) {
    return {};
  }
}

/// The command line of a sweep on several processes, each of which computes one shard by itself;
/// none for other commands, and none for errors that the ranks report together in one line.
std::optional<CommandLine> line_of_shard(const std::vector<std::string>& words) {
  const std::optional<Shard> shard = shard_of_process();
  if (!shard) return {};
  std::optional<CommandLine> line = parsed(words);
  if (!line || line->command == nullptr || !line->command->has_shards || !line->answer.empty())
    return {};
  if (!have_one_command_line())
    throw InputError(
        "expected one command line with one -n for all parts of a sweep under mpirun, found "
        "several");
  if (!line->shares.shard.empty()) {
    if (shard->index > 1) std::_Exit(kUnusableInput);  // one message is enough
    throw InputError("--shard: not allowed under mpirun, whose processes are the parts; remove it");
  }
  line->shares.shard = fmt::format("{}/{}", shard->index, shard->count);
  line->shares.threads = std::max(1, line->shares.threads);
  return line;
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

/// Reports the exception being handled; there may be no memory for more than a line.
int told_without_console() noexcept {
  try {
    const Failure found = failure("starting or ending the command");
    tell_without_console(flexneck::printable(found.text).c_str());
    return found.exit_code;
  } catch (...) {
    tell_without_console(kNoMemory);
    return kComputationFailed;
  }
}

[[noreturn]] void end_by_library() {
  flexneck::clean_up_now();
  tell_without_console("a library has terminated the program; check the free memory");
  std::_Exit(kComputationFailed);
}

/// Handles exceptions that a library or a thread does not let through.
[[noreturn]] void terminate() {
  if (!std::current_exception()) end_by_library();
  const int code = told_without_console();
  flexneck::clean_up_now();
  std::_Exit(code);
}

bool has_ended = false;

/// Exit handler: if MPI cannot start, it ends the process with the code of a failed verification.
void refuse_end_by_library() {
  if (!has_ended) end_by_library();
}

}  // namespace

int main(int argc, char** argv) {
  prepare_process();
  const std::span<char*> words(argv, static_cast<std::size_t>(argc));
  if (is_child(words)) child_main(words, {{"copy", copy_task}});
  std::set_terminate(terminate);
  std::atexit(refuse_end_by_library);
  int code = kComputationFailed;
  try {
    flexneck::clean_up_on_signals();
    code = run(argc, argv);
  } catch (...) {
    code = told_without_console();
  }
  has_ended = true;
  return code;
}
