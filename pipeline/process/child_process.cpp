// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/child_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/exec_pointers.h"
#include "pipeline/process/spawn_actions.h"

namespace flexneck::pipeline {

namespace {

constexpr std::size_t kMaxLine = 1 << 16;
constexpr int kLook_ms = 20;

/// Variables that tell MPI its ranks, and that of the folder for temporary files, which is set
/// anew.
constexpr std::array<std::string_view, 5> kNotInherited = {"OMPI_", "PMIX_", "PMI_", "OPAL_",
                                                           "TMPDIR="};

std::vector<std::string> environment_with(const std::filesystem::path& temporary) {
  std::vector<std::string> variables = {"TMPDIR=" + temporary.string()};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    if (std::none_of(kNotInherited.begin(), kNotInherited.end(),
                     [&](std::string_view prefix) { return text.starts_with(prefix); })) {
      variables.emplace_back(text);
    }
  }
  return variables;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

ChildEnd end_of(int status, const rusage& used, double clock_s) {
  const bool is_signal = WIFSIGNALED(status);
  return {.exit_code = is_signal ? 0 : WEXITSTATUS(status),
          .signal = is_signal ? WTERMSIG(status) : 0,
          .processor_s = seconds(used.ru_utime) + seconds(used.ru_stime),
          .clock_s = clock_s};
}

}  // namespace

ChildProcess::ChildProcess(const std::filesystem::path& program,
                           const std::vector<std::string>& arguments,
                           const std::filesystem::path& temporary) {
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
    throw ComputationError("a pipe to a child process cannot be created: " +
                           std::string(std::strerror(errno)));
  }
  FileDescriptor to_read(pipe_ends[0]);
  const FileDescriptor to_write(pipe_ends[1]);
  std::vector<std::string> words = {program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = environment_with(temporary);
  // Nothing to read, all output into one pipe, every other file closed.
  SpawnActions actions;
  actions.open(STDIN_FILENO, "/dev/null", O_RDONLY);
  actions.duplicate(to_write.get(), STDOUT_FILENO);
  actions.duplicate(to_write.get(), STDERR_FILENO);
  actions.close_from(STDERR_FILENO + 1);
  const SignalHold hold;
  const int error = posix_spawn(&id_, program.c_str(), actions.get(), actions.attributes(),
                                exec_pointers(words).data(), exec_pointers(variables).data());
  if (error != 0)
    throw ComputationError(program.string() +
                           ": cannot be started as a child process: " + std::strerror(error));
  cleanup_ = SignalCleanup(id_);
  output_ = std::move(to_read);
}

ChildProcess::~ChildProcess() {
  if (id_ < 0) return;
  kill(id_, SIGKILL);
  uninterrupted([&] { return waitpid(id_, nullptr, 0); });
}

bool ChildProcess::has_output(int timeout_ms) const {
  pollfd readable{output_.get(), POLLIN, 0};
  return is_open_ && poll(&readable, 1, timeout_ms) > 0;
}

void ChildProcess::read_lines(const LineReceiver& on_line) {
  std::array<char, 4096> bytes{};
  const ssize_t count = read(output_.get(), bytes.data(), bytes.size());
  if (count <= 0) {
    is_open_ = count < 0 && errno == EINTR;
    return;
  }
  unread_.append(bytes.data(), static_cast<std::size_t>(count));
  std::size_t begin = 0;
  for (std::size_t end = unread_.find('\n'); end != std::string::npos;
       end = unread_.find('\n', begin)) {
    on_line(unread_.substr(begin, end - begin));
    begin = end + 1;
  }
  unread_.erase(0, begin);
  if (unread_.size() > kMaxLine) on_line(std::exchange(unread_, {}));
}

ChildEnd ChildProcess::wait(const LineReceiver& on_line) {
  int status = 0;
  rusage used{};
  pid_t ended = 0;
  while (ended == 0) {
    // The output ends with the process, unless a program that it started still holds it.
    if (has_output(kLook_ms)) read_lines(on_line);
    ended = wait4(id_, &status, is_open_ ? WNOHANG : 0, &used);
    if (ended < 0 && errno == EINTR) ended = 0;
  }
  cleanup_.reset();  // where a signal has ended the child, this waits for the end of the process
  if (ended < 0)
    throw ComputationError("a child process was lost: the operating system has ended it");
  id_ = -1;
  while (has_output(0)) read_lines(on_line);
  if (!unread_.empty()) on_line(std::exchange(unread_, {}));
  const std::chrono::duration<double> clock = std::chrono::steady_clock::now() - start_;
  return end_of(status, used, clock.count());
}

}  // namespace flexneck::pipeline
