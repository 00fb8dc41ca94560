// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <sys/types.h>

namespace flexneck::pipeline {

/// Resources that a child process may use.
struct ChildLimits {
  std::uint64_t memory_bytes = 0;  ///< in addition to the program's memory at its start
  unsigned processor_s = 0;        ///< processor time; 0: unlimited
  /// Elapsed time; 0: unlimited; ends a waiting child, and is long because the machine may be busy.
  unsigned clock_s = 0;
  std::uint64_t later_memory_bytes = 0;  ///< limit after limit_what_follows(); 0: unchanged
};

/// Limits this process, without core dumps, and ends it together with its parent.
/// @param parent  the process that started this one
/// @throws ComputationError if the system refuses a limit.
void limit_this_process(const ChildLimits& limits, pid_t parent);

/// Limits the time anew, from now on, and raises the limit of memory, for the work after a file is
/// read.
/// @param processor_s  at least 1; the elapsed time may be kClockPerProcessor times as long
void limit_what_follows(unsigned processor_s);

/// Ratio of elapsed time to processor time, since the machine may have other work.
constexpr unsigned kClockPerProcessor = 20;

}  // namespace flexneck::pipeline
