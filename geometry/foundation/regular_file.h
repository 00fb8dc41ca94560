// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>

namespace flexneck {

/// Bytes of a file that is to be read. A folder has no contents, a pipe waits for them, a device
/// has them without end.
/// @throws InputError if there is no such file, or if it is none of the regular kind.
std::uintmax_t size_of_file(const std::filesystem::path& file);

}  // namespace flexneck
