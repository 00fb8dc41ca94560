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
  std::uint64_t later_memory_bytes = 0;  ///< once what follows is limited; 0: no more than before
};

/// Limits this process, without core dumps, and ends it together with its parent.
/// @param parent  the process that started this one
/// @throws ComputationError if the system refuses a limit.
void limit_this_process(const ChildLimits& limits, pid_t parent);

/// For what comes once a file is read: limits the time anew, from now on, and raises the limit of
/// memory.
/// @param processor_s  at least 1; on the clock it may take kClockPerProcessor times as long
void limit_what_follows(unsigned processor_s);

/// The machine may have other work.
constexpr unsigned kClockPerProcessor = 20;

}  // namespace flexneck::pipeline
