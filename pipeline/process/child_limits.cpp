// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/child_limits.h"

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "geometry/foundation/error.h"

namespace flexneck::pipeline {

namespace {

/// Limit of the stack: endless recursion is not limited by memory if the stack is unlimited.
constexpr rlim_t kStackBytes = 64U << 20U;

/// Size of the data segment at start: data of libraries, stacks and, under a sanitizer, terabytes
/// that are reserved but not used.
std::uint64_t bytes_at_start() {
  std::ifstream file("/proc/self/statm");
  constexpr int kColumn = 6;  // size, resident, shared, text, library, data
  std::string column;
  for (int k = 0; k < kColumn; ++k) std::getline(file, column, ' ');
  std::uint64_t pages = 0;
  std::from_chars(column.data(), column.data() + column.size(), pages);
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void limit(__rlimit_resource_t resource, rlim_t soft, rlim_t hard) {
  const rlimit value{soft, hard};
  if (setrlimit(resource, &value) != 0) {
    throw ComputationError("the operating system does not allow limits on a child process");
  }
}

/// Resets a signal, since one ignored or blocked in the parent would not end the child.
void receive(int signal) {
  std::signal(signal, SIG_DFL);
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, signal);
  sigprocmask(SIG_UNBLOCK, &one, nullptr);
}

}  // namespace

void limit_this_process(const ChildLimits& limits, pid_t parent) {
  if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0)
    throw ComputationError(
        "the operating system cannot end a child process together with its parent");
  if (getppid() != parent) std::_Exit(EXIT_FAILURE);  // the parent ended before
  limit(RLIMIT_CORE, 0, 0);
  const rlim_t start = bytes_at_start();
  limit(RLIMIT_DATA, start + limits.memory_bytes,
        start + std::max(limits.memory_bytes, limits.later_memory_bytes));
  limit(RLIMIT_STACK, kStackBytes, kStackBytes);  // grows with the calls from now on
  receive(SIGXCPU);
  receive(SIGALRM);
  if (limits.processor_s > 0) limit(RLIMIT_CPU, limits.processor_s, RLIM_INFINITY);
  alarm(limits.clock_s);
}

void limit_what_follows(unsigned processor_s) {
  rlimit memory{};
  if (getrlimit(RLIMIT_DATA, &memory) != 0)
    throw ComputationError("the operating system does not report the limits of a child process");
  limit(RLIMIT_DATA, memory.rlim_max, memory.rlim_max);
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto before = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec);
  limit(RLIMIT_CPU, before + processor_s, RLIM_INFINITY);
  alarm(kClockPerProcessor * processor_s);
}

}  // namespace flexneck::pipeline
