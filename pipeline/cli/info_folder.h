// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace flexneck::pipeline {

/// Describes a folder of results: the study that it remembers, its verdict if it was verified, and
/// a line for each file, or for each kind where there are many, as of runs.
/// @throws InputError if the folder holds nothing of flexneck.
std::string folder_text(const std::filesystem::path& folder);

}  // namespace flexneck::pipeline
