// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "pipeline/language/document/key.h"

namespace flexneck::pipeline {

/// Table of keys of a file with the report's remarks on the paper.
std::span<const Key> context_keys();

/// Reads the remarks on contradictions and omissions of the paper.
/// @throws InputError if the file lacks required data.
std::vector<std::string> read_paper_remarks(const std::filesystem::path& path);

}  // namespace flexneck::pipeline
