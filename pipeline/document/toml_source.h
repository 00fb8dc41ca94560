// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "geometry/foundation/provenance.h"
#include "pipeline/document/document_source.h"

namespace flexneck::pipeline {

inline constexpr std::size_t kMaxFiles = 100;       ///< included, or of assemblies
inline constexpr std::size_t kDeepestInclude = 16;  ///< files within one another

/// What is done to the table of each file before the one that includes it is put over it.
using Preparation = std::function<void(toml::table&)>;

/// Parses a file and everything it includes into one table. The files read are appended to `files`.
toml::table parse_with_includes(const DocumentSource& source, std::vector<InputFile>& files,
                                const Preparation& prepare);

/// Applies one "dotted.key=value" from the command line.
void apply_setting(toml::table& root, const std::string& setting);

/// The node as TOML has it, whatever the locale.
std::string toml_text(const toml::node& node);

/// "<file>:<line>:<column>: ", or "command line: " for what no file holds.
std::string location_of(const toml::node& node);

}  // namespace flexneck::pipeline
