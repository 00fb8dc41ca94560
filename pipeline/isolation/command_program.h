// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace flexneck::pipeline {

/// The command `flexneck`, which does the tasks of child processes: this program, or what stands as
/// bin/flexneck or flexneck above the Python module that this is a part of.
/// @throws ComputationError if there is none above the module.
std::filesystem::path command_program();

}  // namespace flexneck::pipeline
