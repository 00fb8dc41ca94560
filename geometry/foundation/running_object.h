// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace flexneck {

/// Path of the file that this code runs from: the program, or the shared object that it is a part
/// of, such as the Python module.
std::filesystem::path running_object();

/// Returns whether running_object() is the program of the process.
bool runs_as_program();

}  // namespace flexneck
