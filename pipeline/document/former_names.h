// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "pipeline/document/key.h"

namespace flexneck::pipeline {

/// Replaces former names of keys and texts by the current ones, keeping their lines and columns.
/// @param path      path of the table in messages; empty for a file
/// @param warnings  gets a line for each replacement
/// @throws InputError for a key that is present under both names
void use_current_names(toml::table& table, std::span<const Key> keys, const std::string& path,
                       std::vector<std::string>& warnings);

/// Replaces former names in a setting of the command line, "dotted.key=value".
std::string with_current_names(const std::string& setting, std::span<const Key> keys,
                               std::vector<std::string>& warnings);

/// Current name of a dotted key, such as one in a file of results.
std::string current_name(const std::string& dotted, std::span<const Key> keys);

}  // namespace flexneck::pipeline
