// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace flexneck::pipeline {

/// What a folder of results holds: the study that it remembers, its verdict where it was verified,
/// and a line for each file, or for each kind where there are many, as of runs.
/// @throws InputError if there is nothing of flexneck's in it.
std::string folder_text(const std::filesystem::path& folder);

}  // namespace flexneck::pipeline
