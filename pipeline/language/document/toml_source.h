// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "geometry/foundation/provenance.h"
#include "pipeline/language/document/document_source.h"

namespace flexneck::pipeline {

/// Maximum number of includes and files of assemblies.
inline constexpr std::size_t kMaxFiles = 100;
inline constexpr std::size_t kDeepestInclude = 16;  ///< maximum depth of nested includes

/// Parses a file and its includes into one table. The files read are appended to `files`.
toml::table parse_with_includes(const DocumentSource& source, std::vector<InputFile>& files);

/// Applies one "dotted.key=value" from the command line.
void apply_setting(toml::table& root, const std::string& setting);

/// Text of the node in TOML syntax, independent of the locale.
std::string toml_text(const toml::node& node);

/// Location "<file>:<line>:<column>: ", or "command line: " for a node of no file.
std::string location_of(const toml::node& node);

}  // namespace flexneck::pipeline
