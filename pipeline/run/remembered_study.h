// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace flexneck::pipeline {

/// Name of the file in a folder of results that records the study they were last made with.
inline constexpr const char* kRememberedStudy = "study.json";

/// A study and the values set for it on the command line.
struct StudyChoice {
  std::filesystem::path study;        ///< path of the file; empty: the built-in study
  std::vector<std::string> settings;  ///< "key=value"
};

/// True if two choices have the same study and values, in any order.
bool same(StudyChoice a, StudyChoice b);

/// Text such as "--set modes.count=4 --set modes.basis=residual".
std::string text_of_settings(const std::vector<std::string>& settings);
/// Text such as "geometry/examples/cantilever.toml --set modes.count=4".
std::string text_of(const StudyChoice& choice);

/// Adds settings to a choice: each key once, with the later value.
StudyChoice with_settings(StudyChoice choice, const std::vector<std::string>& more);

/// Reads the study that a folder of results was last made with; none without the file.
/// @throws InputError if the file is not one of flexneck.
std::optional<StudyChoice> remembered_study(const std::filesystem::path& folder);

/// Fails before the work if study.json cannot record the path.
/// @throws InputError
void require_rememberable(const std::filesystem::path& folder, const StudyChoice& choice);

/// Writes that file, with the path of the study relative to the folder, or to the shipped files if
/// it is one of them, since those may be elsewhere later.
void remember_study(const std::filesystem::path& folder, const StudyChoice& choice);

}  // namespace flexneck::pipeline
