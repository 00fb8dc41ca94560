// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexneck::pipeline {

/// A text file of ISO/TS 13499: lines "Key   :value", followed, from the first line without a colon
/// on, by samples. Keys are compared without padding and case; of a key that occurs several times,
/// such as Comments, the first counts. Empty lines are skipped. The text may be ASCII, ISO-8859-1,
/// Windows-1252 or UTF-8.
class DescriptorFile {
 public:
  struct Line {
    int number = 0;    ///< counted from 1
    std::string key;   ///< empty for samples
    std::string text;  ///< value or sample, without surrounding blanks
  };

  /// Reads a file.
  /// @throws InputError if the file cannot be read, is not text, or has a line with a colon and no
  /// key.
  explicit DescriptorFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  std::span<const Line> descriptors() const { return std::span(lines_).first(descriptors_); }
  std::span<const Line> samples() const { return std::span(lines_).subspan(descriptors_); }

  /// The line of a key; null if there is none, or it is empty or NOVALUE.
  const Line* find(std::string_view key) const;
  /// Line of a key. @throws InputError if there is none.
  const Line& need(std::string_view key) const;
  /// Value of a key as a number. @throws InputError if it is missing or not a finite number.
  double number(std::string_view key) const;
  /// Number in a line, a sample or a value. @throws InputError if it is not a finite number.
  double number(const Line& line) const;

  /// Throws InputError with file and line.
  [[noreturn]] void refuse(const Line& line, const std::string& problem) const;
  /// Throws InputError with the file alone.
  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  std::filesystem::path path_;
  std::vector<Line> lines_;
  std::size_t descriptors_ = 0;
};

}  // namespace flexneck::pipeline
