// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace flexneck::pipeline {

/// Path of the command `flexneck`, which runs the tasks of child processes: this program, or
/// bin/flexneck or flexneck above the Python module that this code is a part of.
/// @throws ComputationError if there is none above the module.
std::filesystem::path command_program();

}  // namespace flexneck::pipeline
