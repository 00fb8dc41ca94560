// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "geometry/foundation/provenance.h"
#include "pipeline/document/document_source.h"
#include "pipeline/document/key.h"

namespace flexneck::pipeline {

/// The tables [variables] and [[assembly]], which studies and models have alike.
Key variables_key();
Key assembly_key();

/// A document with everything that belongs to it, and what reading it has told.
struct DocumentContent {
  toml::table root;
  std::vector<InputFile> files;       ///< each once
  std::vector<Parameter> parameters;  ///< the variables and the files of the assemblies
  std::vector<std::string> warnings;
};

/// Reads a document: a file with what it includes, the settings of the command line, the values of
/// its variables in the place of their names, and the files of its assemblies, whose tables stand
/// among its own under names with the prefix "<assembly>:".
/// @param settings    "dotted.key=value"; variables.NAME and assembly.NAME.variables.NAME, too
/// @param keys  of the format; what earlier versions called otherwise gets its name of today
/// @throws InputError with file, line, column and dotted key
DocumentContent read_document(const DocumentSource& source,
                              const std::vector<std::string>& settings, std::span<const Key> keys);

}  // namespace flexneck::pipeline
