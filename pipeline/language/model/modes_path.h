// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

inline constexpr Key kMadeByKey =
    Key::text("made_by", kNone,
              "Command that creates modes_file, shown in the error message if the file is missing",
              {.changes_results = false});

/// Path of the modes' file that a key names: in the folder of the file with the key, or else, since
/// commands write there, in the current folder. If it is in neither, the first path.
/// @throws InputError at the key if it is in neither and the table names the command that makes it.
std::filesystem::path modes_path(const StudyTable& table, const std::string& key);

}  // namespace flexneck::pipeline
