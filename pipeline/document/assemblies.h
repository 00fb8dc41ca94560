// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "geometry/foundation/provenance.h"

namespace flexneck::pipeline {

/// Reads a document: a file with what it includes, the settings of the command line, the values of
/// its variables in the place of their names, and the files of its assemblies, whose tables stand
/// among its own under names with the prefix "<assembly>:".
/// @param settings    "dotted.key=value"; variables.NAME and assembly.NAME.variables.NAME, too
/// @param files       receives the files read, each once
/// @param parameters  receives the variables and the files of the assemblies
/// @throws InputError with file, line, column and dotted key
toml::table read_document(const std::filesystem::path& path,
                          const std::vector<std::string>& settings, std::vector<InputFile>& files,
                          std::vector<Parameter>& parameters);

}  // namespace flexneck::pipeline
