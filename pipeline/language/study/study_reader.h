// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/language/document/study_document.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

/// Repeatedly reads a study that read_study() has read and checked, with other values of the same
/// keys: its files are parsed once, unless the values are of variables. The studies are those of
/// read_study(), except that cases not chosen by the study's key `cases` are neither checked again
/// nor recorded among the parameters. For one thread.
class StudyReader {
 public:
  /// @param settings  settings common to all readings
  StudyReader(std::filesystem::path path, std::vector<std::string> settings);

  /// @param more  "key=value"; if the keys differ from the last reading, the files are parsed again
  /// @throws InputError as read_study() does.
  Study read(const std::vector<std::string>& more);

 private:
  std::filesystem::path path_;
  std::vector<std::string> settings_;
  std::vector<std::string> keys_;  ///< keys whose values were set in the document
  std::optional<StudyDocument> document_;
  std::vector<TestSection> tests_;  ///< tests of an earlier reading, whose regulations are kept
};

}  // namespace flexneck::pipeline
