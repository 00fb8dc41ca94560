// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace flexneck::pipeline {

/// Kinds of flexneck's TOML files.
enum class FileKind { study, model };

/// Kind of a file by its tables, those of included files too: a table that only studies have, such
/// as [geometry], makes a study, and otherwise [[body]] a model. The tables' content is not read.
/// @throws InputError for a file that is missing or does not parse.
FileKind kind_of_file(const std::filesystem::path& path);

/// Explains why a command refuses a file. @throws InputError if it is of the other kind, naming the
/// command that takes it, or if it is a mesh or a shape.
void refuse_other_kind(const std::filesystem::path& path, FileKind expected);

}  // namespace flexneck::pipeline
