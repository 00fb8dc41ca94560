// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace flexneck {

/// Bytes that this process may still write into a folder; infinite where the system does not say.
double available_disk(const std::filesystem::path& folder);

/// Refuses what will not fit onto the disk, before it is written.
/// @param what needs them, e.g. "the history of 1000000 outputs"
/// @param advice what to do instead
/// @throws InputError "<folder>: <what> takes about 12.3 GB of the disk, 8.1 GB are free: <advice>"
void require_disk(const std::filesystem::path& folder, const std::string& what, double bytes,
                  const std::string& advice);

}  // namespace flexneck
