// SPDX-License-Identifier: GPL-3.0-or-later
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <new>
#include <optional>
#include <span>
#include <sstream>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "fe_modal/solve/distributed/ranks.h"
#include "geometry/foundation/atomic_file.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/printable.h"
#include "geometry/foundation/signal_cleanup.h"
#include "pipeline/commands/child_tasks.h"
#include "pipeline/commands/commands.h"
#include "pipeline/folder/folder_lock.h"
#include "pipeline/version.h"

namespace {

using namespace flexneck::pipeline;
using flexneck::fe_modal::Ranks;

constexpr const char* kNoMemory = "the memory that is free does not suffice for this";
constexpr int kVerificationFailed = 1;
constexpr int kUnusableInput = 2;
constexpr int kComputationFailed = 3;

struct Arguments {
  std::string line = "flexneck";  ///< as the user gave it
  std::string command = "run";
  std::vector<std::string> files;
  std::string folder = "out";
  std::vector<std::string> settings;
  bool quiet = false;
  bool verbose = false;
  bool show = false;
  bool force = false;
  std::string target;
  bool is_binary = false;

  Verbosity verbosity() const {
    return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal;
  }
};

void describe(CLI::App& app, Arguments& arguments) {
  app.set_version_flag("--version", std::string("flexneck ") + kVersion + " (" + kGitHash + ")");
  app.add_option("command", arguments.command, "What to do; see below")->option_text("COMMAND");
  app.add_option("files", arguments.files,
                 "Study file (default: the built-in Hybrid III study), the model of simulate, or "
                 "the files of info")
      ->option_text("FILE ...");
  app.add_option("-o,--out,--output", arguments.folder, "Folder for results")
      ->option_text("DIR [out]");
  app.add_option("--set", arguments.settings, "Use another value, e.g. modes.count=12")
      ->option_text("KEY=VALUE ...")
      ->allow_extra_args(false);
  app.add_option_function<std::string>(
         "--preset",
         [&](const std::string& name) { arguments.settings.push_back("mesh.preset=" + name); },
         "Mesh divisions: default or paper; as --set mesh.preset=NAME")
      ->option_text("NAME");
  app.add_option_function<std::string>(
         "--refine",
         [&](const std::string& cuts) { arguments.settings.push_back("mesh.refine=" + cuts); },
         "Cut every element in N + 1 in each direction; as --set mesh.refine=N")
      ->option_text("N");
  app.add_flag_function(
      "--certify",
      [&](std::int64_t /*times*/) { arguments.settings.emplace_back("modes.certify=true"); },
      "Prove that no mode is missing and estimate the mesh's error; as --set modes.certify=true");
  app.add_option_function<std::string>(
         "--solver",
         [&](const std::string& name) { arguments.settings.push_back("modes.solver=" + name); },
         "Of modes: direct, or iterative in less memory; as --set modes.solver=NAME")
      ->option_text("NAME");
  app.add_flag("--force", arguments.force, "With run: redo what has not changed, too");
  app.add_flag("--show", arguments.show, "With mesh: print dimensions and a section, mesh nothing");
  app.add_option("--to", arguments.target, "With export: the file to write")
      ->option_text("FILE.msh|.inp|.mtx|.petsc|.dat");
  app.add_flag("--binary", arguments.is_binary, "With export: a .msh in bytes instead of text");
  CLI::Option* const quiet = app.add_flag("-q,--quiet", arguments.quiet, "Print errors only");
  app.add_flag("-v,--verbose", arguments.verbose, "Print what each stage does")->excludes(quiet);
  std::string footer = "Commands:\n";
  for (const Command& command : commands()) {
    footer +=
        "  " + command.name + std::string(12 - command.name.size(), ' ') + command.help + "\n";
  }
  app.footer(footer +
             "\nExit codes: 0 done, 1 a verification failed, 2 unusable input, "
             "3 a computation failed.");
}

/// Does the command. @param take_lock is called once its arguments are known to be right
bool do_command(const Command& command, const Arguments& arguments, const ResultsFolder& folder,
                const Console& console, const Ranks* ranks,
                const std::function<void()>& take_lock) {
  if (command.run_on_files != nullptr) {
    take_lock();
    return command.run_on_files(
        {{arguments.files.begin(), arguments.files.end()}, arguments.settings, folder, console});
  }
  if (arguments.files.size() > 1) {
    throw flexneck::InputError(arguments.command + ": expected one study, found '" +
                               arguments.files[1] + "' too");
  }
  const Study study = read_study(
      arguments.files.empty() ? built_in_study() : std::filesystem::path(arguments.files.front()),
      arguments.settings);
  take_lock();
  if (ranks != nullptr && arguments.command != "modes" && arguments.command != "run") {
    console.step("Only modes are computed on many ranks: '" + arguments.command +
                 "' runs on the first");
  }
  return (arguments.show ? show_command : command.run)(
      {study, folder, console, arguments.target, arguments.is_binary, ranks, arguments.force});
}

bool execute(const Arguments& arguments, const Console& console, const Ranks* ranks) {
  const std::vector<Command>& list = commands();
  const std::size_t which =
      flexneck::find_name(flexneck::names_of(list), arguments.command, "command");
  if (arguments.show && arguments.command != "mesh") {
    throw flexneck::InputError("--show belongs to the command mesh, found with '" +
                               arguments.command + "'");
  }
  const ResultsFolder folder(arguments.folder);
  std::optional<FolderLock> lock;
  const auto take_lock = [&] {
    if (!list[which].writes_results || arguments.show) return;
    lock.emplace(folder.path(), arguments.line,
                 [&](const std::string& line) { console.warning(line); });
  };
  const bool passed = do_command(list[which], arguments, folder, console, ranks, take_lock);
  if (lock) flexneck::sync_folder(folder.path());
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
  } catch (const flexneck::InputError& error) {
    return {kUnusableInput, error.what()};
  } catch (const std::bad_alloc&) {
    return {kComputationFailed, kNoMemory};
  } catch (const std::exception& error) {
    return {kComputationFailed, error.what()};
  } catch (...) {
    return {kComputationFailed, "failed for an unknown reason"};
  }
}

int exit_code_of(const Arguments& arguments, const Ranks* ranks) {
  const Console console(arguments.verbosity());
  try {
    return execute(arguments, console, ranks) ? 0 : kVerificationFailed;
  } catch (...) {
    const Failure found = failure();
    console.error(found.text);
    return found.exit_code;
  }
}

/// What asks for help or the version comes as an "error", too.
int exit_code_of(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream help;
  std::ostringstream ignored;
  const Console console(Verbosity::normal);
  if (app.exit(error, help, ignored) != 0) {
    console.error(std::string(error.what()) + "; 'flexneck --help' lists what there is");
    return kUnusableInput;
  }
  std::string text = help.str();
  text.erase(text.find_last_not_of('\n') + 1);
  console.result(text);
  return 0;
}

int run(int argc, char** argv) {
  std::optional<Ranks> ranks;
  if (Ranks::are_many()) {
    ranks.emplace([](const std::string& line) {
      fmt::print(stderr, "flexneck: {}\n", flexneck::printable(line));
    });
  }
  if (ranks && !ranks->is_leader()) {
    ranks->serve();
    return 0;
  }
  CLI::App app("From the geometry of a manikin's neck to its motion.", "flexneck");
  Arguments arguments;
  for (int k = 1; k < argc; ++k) arguments.line += std::string(" ") + argv[k];
  describe(app, arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return exit_code_of(app, error);
  }
  return exit_code_of(arguments, ranks ? &*ranks : nullptr);
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
