// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace flexneck {

/// Bytes that this process may still write into a folder; infinite if the system does not tell.
double available_disk(const std::filesystem::path& folder);

/// Refuses data that will not fit onto the disk before they are written.
/// @param what names the data, e.g. "the history of 1000000 outputs"
/// @param advice tells the user what to do instead
/// @throws InputError "<folder>: <what> takes about 12.3 GB of the disk, 8.1 GB are free: <advice>"
void require_disk(const std::filesystem::path& folder, const std::string& what, double bytes,
                  const std::string& advice);

}  // namespace flexneck
