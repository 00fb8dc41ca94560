// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace flexneck {

/// The file that this code runs from: the program, or the shared object that it is a part of, such
/// as the Python module.
std::filesystem::path running_object();

/// Whether that is the program of the process.
bool runs_as_program();

}  // namespace flexneck
