// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "pipeline/document/key.h"

namespace flexneck::pipeline {

/// Keys and texts that were called otherwise in earlier versions get the names that they have now,
/// at their lines and columns.
/// @param path      of the table in messages; empty for a file
/// @param warnings  gets a line for each
/// @throws InputError for a key that is there under both names
void use_current_names(toml::table& table, std::span<const Key> keys, const std::string& path,
                       std::vector<std::string>& warnings);

/// The same for a setting of the command line, "dotted.key=value".
std::string with_current_names(const std::string& setting, std::span<const Key> keys,
                               std::vector<std::string>& warnings);

/// The name that a dotted key has now, such as one of a file of results.
std::string current_name(const std::string& dotted, std::span<const Key> keys);

}  // namespace flexneck::pipeline
