// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/report/figures/gnuplot.h"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "geometry/foundation/error.h"
#include "pipeline/report/embedding.h"

namespace flexneck::pipeline {

namespace {

constexpr const char* kComplaints = "gnuplot.err";

/// What the new process does before it becomes gnuplot.
class SpawnActions {
 public:
  explicit SpawnActions(const std::filesystem::path& folder) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, 2, kComplaints, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

void run_gnuplot(const std::filesystem::path& folder, const std::string& script_name) {
  const SpawnActions actions(folder);
  std::string program = "gnuplot";
  std::string script = script_name;
  const std::array<char*, 3> arguments = {program.data(), script.data(), nullptr};
  pid_t process = 0;
  const int failure =
      posix_spawnp(&process, program.c_str(), actions.get(), nullptr, arguments.data(), environ);
  if (failure == ENOENT) {
    throw InputError(
        "report: gnuplot draws the figures and is missing; install the package "
        "gnuplot-nox");
  }
  int status = 0;
  if (failure != 0 || waitpid(process, &status, 0) != process || status != 0) {
    throw ComputationError("report: gnuplot failed: " + text_of_file(folder / kComplaints));
  }
}

}  // namespace flexneck::pipeline
