// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "pipeline/language/document/key.h"

namespace flexneck::pipeline {

/// Tables of a format, one line each with a description.
std::string tables_text(std::span<const Key> keys);

/// Describes a table and all its keys, including those of its sub-tables: type, unit, default,
/// allowed values and meaning. Lines have at most 100 columns.
/// @param path  name of the table in messages: "geometry.materials"
std::string table_text(const std::string& path, const Key& table);

/// Describes one key in the same form.
std::string key_text(const Key& key);

}  // namespace flexneck::pipeline
