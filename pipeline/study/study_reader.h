// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/document/study_document.h"
#include "pipeline/study/study.h"

namespace flexneck::pipeline {

/// Reads a study that read_study() has read and checked again and again with other values of the
/// same keys: its files are parsed once, unless the values are of variables. The studies are those
/// of read_study(), but that cases which the study's key `cases` does not choose are not looked at
/// again, nor recorded among the parameters. For one thread.
class StudyReader {
 public:
  /// @param settings  that hold every time
  StudyReader(std::filesystem::path path, std::vector<std::string> settings);

  /// @param more  "key=value"; other keys than the last time have the files parsed again
  /// @throws InputError as read_study() does.
  Study read(const std::vector<std::string>& more);

 private:
  std::filesystem::path path_;
  std::vector<std::string> settings_;
  std::vector<std::string> keys_;  ///< that the document has been given values of
  std::optional<StudyDocument> document_;
  std::vector<TestSection> tests_;  ///< of an earlier reading: their regulations stay
};

}  // namespace flexneck::pipeline
