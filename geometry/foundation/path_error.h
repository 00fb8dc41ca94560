// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace flexneck {

// Handling of the file system errors of the standard library, for messages to the user.

/// Returns whether the path is the cause, so that it is unusable input: too long, missing, not
/// permitted.
bool is_of_path(const std::filesystem::filesystem_error& error);

/// Message such as "<path>: File name too long; a name has at most 255 bytes, a path 4095".
std::string text_of(const std::filesystem::filesystem_error& error);

}  // namespace flexneck
