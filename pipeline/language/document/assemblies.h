// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "geometry/foundation/provenance.h"
#include "pipeline/language/document/document_source.h"
#include "pipeline/language/document/key.h"

namespace flexneck::pipeline {

/// Keys of the tables [variables] and [[assembly]], which studies and models share.
Key variables_key();
Key assembly_key();

/// A document with everything that belongs to it.
struct DocumentContent {
  toml::table root;
  std::vector<InputFile> files;       ///< each file once
  std::vector<Parameter> parameters;  ///< the variables and the files of the assemblies
};

/// Reads a document: a file with its includes, the settings of the command line, the values of its
/// variables in place of their names, and the files of its assemblies, whose tables are added to
/// its own under names with the prefix "<assembly>:".
/// @param settings    "dotted.key=value"; variables.NAME and assembly.NAME.variables.NAME, too
/// @param keys  keys of the format
/// @throws InputError with file, line, column and dotted key
DocumentContent read_document(const DocumentSource& source,
                              const std::vector<std::string>& settings, std::span<const Key> keys);

}  // namespace flexneck::pipeline
