// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "pipeline/document/key.h"

namespace flexneck::pipeline {

/// The table of keys of a file with what the report says of the paper.
std::span<const Key> context_keys();

/// Where the paper contradicts itself or says too little.
/// @throws InputError if the file does not say what it must.
std::vector<std::string> read_paper_remarks(const std::filesystem::path& path);

}  // namespace flexneck::pipeline
