// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/results/plotting/gnuplot.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

#include "geometry/foundation/error.h"
#include "geometry/foundation/exec_pointers.h"
#include "geometry/foundation/file_descriptor.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/signal_cleanup.h"
#include "pipeline/process/spawn_actions.h"

namespace flexneck::pipeline {

namespace {

constexpr const char* kComplaints = "gnuplot.err";

/// Environment passed to gnuplot. Its own variables (GNUPLOT_LIB, GNUTERM, FIT_SCRIPT …) would make
/// it read other files.
std::vector<std::string> environment() {
  std::vector<std::string> variables = {"LC_ALL=C.UTF-8"};
  for (const char* const name : {"PATH", "LD_LIBRARY_PATH", "TMPDIR"})
    if (const char* const value = std::getenv(name))
      variables.push_back(std::string(name) + "=" + value);
  return variables;
}

}  // namespace

void run_gnuplot(const std::filesystem::path& folder, const std::string& script_name) {
  SpawnActions actions;
  actions.enter(folder);
  actions.open(STDIN_FILENO, "/dev/null", O_RDONLY);
  actions.open(STDOUT_FILENO, "/dev/null", O_WRONLY);
  actions.open(STDERR_FILENO, kComplaints, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  // -d: skips the settings of the machine and of the user, which are programs.
  std::vector<std::string> arguments = {"gnuplot", "-d", script_name};
  std::vector<std::string> variables = environment();
  pid_t process = 0;
  int failure = 0;
  SignalCleanup cleanup;
  {
    const SignalHold hold;
    failure = posix_spawnp(&process, arguments.front().c_str(), actions.get(), actions.attributes(),
                           exec_pointers(arguments).data(), exec_pointers(variables).data());
    if (failure == 0) cleanup = SignalCleanup(process);
  }
  if (failure == ENOENT) {
    throw InputError(
        "report: gnuplot, which draws the figures, was not found; install the package gnuplot-nox");
  }
  int status = 0;
  if (failure != 0)
    throw ComputationError(std::string("report: gnuplot cannot be started: ") +
                           std::strerror(failure));
  const pid_t ended = uninterrupted([&] { return waitpid(process, &status, 0); });
  cleanup.reset();  // where a signal has ended gnuplot, this waits for the end of the process
  if (ended != process || status != 0)
    throw ComputationError("report: gnuplot failed: " + text_of_file(folder / kComplaints));
}

}  // namespace flexneck::pipeline
