// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "pipeline/document/key.h"

namespace flexneck::pipeline {

/// The tables of a format, a line each with what they are.
std::string tables_text(std::span<const Key> keys);

/// A table and all its keys, those of the tables in it too: type, unit, default, what is allowed
/// and what it means. Lines have at most 100 columns.
/// @param path  name of the table as messages give it: "geometry.materials"
std::string table_text(const std::string& path, const Key& table);

/// One key, as above.
std::string key_text(const Key& key);

}  // namespace flexneck::pipeline
