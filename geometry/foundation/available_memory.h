// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/error.h"

namespace flexneck {

/// Thrown when memory runs out during a computation. It tells nothing else: neither that a matrix
/// is not definite nor that an iteration does not converge.
class OutOfMemory : public ComputationError {
 public:
  using ComputationError::ComputationError;
};

/// Bytes that this process may still allocate: the least of the machine's free memory
/// (MemAvailable), the rest of its control group's limit, and the rest of its address space limit
/// (ulimit -v). Infinite if the system does not tell.
/// @param root folder of /proc and /sys; tests pass another one
double available_memory(const std::filesystem::path& root = "/");

/// Peak memory of this process so far, in bytes.
double peak_memory();

/// Text of a size of memory, as "12.3 GB".
std::string memory_text(double bytes);

/// Exception with the text "memory runs out while <doing>: 1.2 GB are taken, 0.3 GB are free;
/// <advice>".
OutOfMemory out_of_memory(const std::string& doing, const std::string& advice);

/// Refuses a computation that will not fit into memory before it starts.
/// @param what names the object that takes the memory, e.g. "the factor of 123 million entries"
/// @param advice tells the user what to do instead
/// @throws InputError "<what> takes about 12.3 GB of memory, 8.1 GB are free: <advice>"
void require_memory(const std::string& what, double bytes, const std::string& advice);

}  // namespace flexneck
