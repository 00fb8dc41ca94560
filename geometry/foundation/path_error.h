// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace flexneck {

// Failures of the file system as the standard library throws them, for those who tell the user.

/// Tells whether the path is at fault, so that it is unusable input: too long, not there, not
/// permitted.
bool is_of_path(const std::filesystem::filesystem_error& error);

/// "<path>: File name too long; a name has at most 255 bytes, a path 4095"
std::string text_of(const std::filesystem::filesystem_error& error);

}  // namespace flexneck
