// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/document/study_document.h"

namespace flexneck::pipeline {

inline constexpr Key kMadeByKey =
    Key::text("made_by", kNone,
              "Command that makes modes_file in the current folder, told where it is missing",
              {.changes_results = false});

/// The file of modes that a key names: from the folder of the file that says so, else, since
/// commands write there, from the current one. If it is in neither, the first one.
/// @throws InputError at the key if it is in neither and the table says what makes it.
std::filesystem::path modes_path(const StudyTable& table, const std::string& key);

}  // namespace flexneck::pipeline
