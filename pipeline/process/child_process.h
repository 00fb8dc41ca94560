// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <sys/types.h>
#include <vector>

#include "geometry/foundation/file_descriptor.h"
#include "geometry/foundation/signal_cleanup.h"

namespace flexneck::pipeline {

/// End of a process: an exit code, or a signal.
struct ChildEnd {
  int exit_code = 0;
  int signal = 0;  ///< 0: none
  double processor_s = 0;
  double clock_s = 0;
};

/// Another program in a process of its own, started by posix_spawn: never by fork, which is not
/// allowed once MPI runs. It inherits no files, reads nothing, and does not know that this process
/// may be one of several under mpirun. It does not outlive this object.
class ChildProcess {
 public:
  /// @param temporary  its folder for temporary files, which remain there however it ends
  /// @throws ComputationError if the program cannot be started.
  ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
               const std::filesystem::path& temporary);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  using LineReceiver = std::function<void(const std::string& line)>;

  /// Passes on each line of the process's standard output and error, without its line break and
  /// truncated if very long, until the process ends. Programs that it started and left behind are
  /// ignored. To be called once.
  ChildEnd wait(const LineReceiver& on_line);

 private:
  bool has_output(int timeout_ms) const;
  void read_lines(const LineReceiver& on_line);

  pid_t id_ = -1;  ///< -1 once it has ended
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  SignalCleanup cleanup_;
  FileDescriptor output_;  ///< end of the pipe from which this process reads
  bool is_open_ = true;    ///< false at the end of the output
  std::string unread_;     ///< beginning of an incomplete line
};

}  // namespace flexneck::pipeline
