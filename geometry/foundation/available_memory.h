// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace flexneck {

/// Bytes that this process may still take: the least of what the machine has (MemAvailable), what
/// the limits of its control group leave, and that of its address space (ulimit -v). Infinite where
/// the system does not say.
/// @param root of /proc and /sys; another one serves tests
double available_memory(const std::filesystem::path& root = "/");

/// "12.3 GB"
std::string memory_text(double bytes);

/// Refuses what will not fit into memory, before it starts.
/// @param what needs them, e.g. "the factor of 123 million entries"
/// @param advice what to do instead
/// @throws InputError "<what> takes about 12.3 GB of memory, 8.1 GB are free: <advice>"
void require_memory(const std::string& what, double bytes, const std::string& advice);

}  // namespace flexneck
