// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace flexneck::pipeline {

/// The file in a folder of results that says what they were last made with.
inline constexpr const char* kRememberedStudy = "study.json";

/// A study and the values that the command line set in it.
struct StudyChoice {
  std::filesystem::path study;        ///< the file; empty: the built-in one
  std::vector<std::string> settings;  ///< "key=value"
};

/// Whether two choices are of the same values, in whatever order.
bool same(StudyChoice a, StudyChoice b);

/// "--set modes.count=4 --set modes.basis=residual"
std::string text_of_settings(const std::vector<std::string>& settings);
/// "geometry/examples/cantilever.toml --set modes.count=4"
std::string text_of(const StudyChoice& choice);

/// The same study with more values set: each key once, the later value.
StudyChoice with_settings(StudyChoice choice, const std::vector<std::string>& more);

/// The study that a folder of results was last made with, from that file; none without the file.
/// @throws InputError if the file is none of ours.
std::optional<StudyChoice> remembered_study(const std::filesystem::path& folder);

/// @throws InputError for a path that study.json could not name; say so before the work is done.
void require_rememberable(const std::filesystem::path& folder, const StudyChoice& choice);

/// Writes that file, with the path of the study from the folder, or from the shipped files if it is
/// one of them: those may stand elsewhere later.
void remember_study(const std::filesystem::path& folder, const StudyChoice& choice);

}  // namespace flexneck::pipeline
