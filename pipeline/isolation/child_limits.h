// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <sys/types.h>

namespace flexneck::pipeline {

/// What a child process may use.
struct ChildLimits {
  std::uint64_t memory_bytes = 0;  ///< beyond what the program has when it starts
  unsigned processor_s = 0;        ///< 0: any time
  unsigned clock_s = 0;            ///< likewise; ends one that waits, others may use the machine
  std::uint64_t later_memory_bytes = 0;  ///< once lift_limits() was called; 0: no more than before
};

/// Limits this process, without core dumps, and ends it together with its parent.
/// @param parent  the process that started this one
/// @throws ComputationError if the system refuses a limit.
void limit_this_process(const ChildLimits& limits, pid_t parent);

/// For what comes once a file is read: takes the limits of time away, and raises that of memory.
void lift_limits();

}  // namespace flexneck::pipeline
