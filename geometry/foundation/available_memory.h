// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/error.h"

namespace flexneck {

/// Memory ran out in the midst of a computation, of which nothing else is known: neither that a
/// matrix is not definite nor that an iteration would not converge.
class OutOfMemory : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

/// Bytes that this process may still take: the least of what the machine has (MemAvailable), what
/// the limits of its control group leave, and that of its address space (ulimit -v). Infinite where
/// the system does not say.
/// @param root of /proc and /sys; another one serves tests
double available_memory(const std::filesystem::path& root = "/");

/// The most that this process has had, bytes.
double peak_memory();

/// "12.3 GB"
std::string memory_text(double bytes);

/// "memory runs out while <doing>: 1.2 GB are taken, 0.3 GB are free; <advice>"
OutOfMemory out_of_memory(const std::string& doing, const std::string& advice);

/// Refuses what will not fit into memory, before it starts.
/// @param what needs them, e.g. "the factor of 123 million entries"
/// @param advice what to do instead
/// @throws InputError "<what> takes about 12.3 GB of memory, 8.1 GB are free: <advice>"
void require_memory(const std::string& what, double bytes, const std::string& advice);

}  // namespace flexneck
