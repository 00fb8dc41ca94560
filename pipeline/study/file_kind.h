// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace flexneck::pipeline {

/// What a TOML file of ours is for.
enum class FileKind { study, model };

/// By its tables, those of files that it includes too: one that only studies have makes a study,
/// such as [geometry], and else [[body]] a model. Nothing is read of what they say.
/// @throws InputError for a file that is missing or does not parse.
FileKind kind_of_file(const std::filesystem::path& path);

/// Of a file that a command refuses. @throws InputError if it is of the other kind, with the
/// command that takes it, or if it is a mesh or a shape.
void refuse_other_kind(const std::filesystem::path& path, FileKind expected);

}  // namespace flexneck::pipeline
