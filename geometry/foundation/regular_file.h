// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

namespace flexneck {

/// Size in bytes of a file to be read. Folders have no content, pipes block until it comes, devices
/// have it without end; all three are refused.
/// @throws InputError if there is no such file, or if it is not a regular file.
std::uintmax_t size_of_file(const std::filesystem::path& file);

}  // namespace flexneck
