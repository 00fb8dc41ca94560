// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexneck::pipeline {

/// A text file of ISO/TS 13499: lines "Key   :value", and behind them, from the first line without
/// a colon on, samples. Keys count without what pads them and without regard to capitals; of a key
/// that is there several times, such as Comments, the first counts. Empty lines count for nothing.
/// The text may be ASCII, ISO-8859-1, Windows-1252 or UTF-8.
class DescriptorFile {
 public:
  struct Line {
    int number = 0;    ///< from 1 on
    std::string key;   ///< empty of samples
    std::string text;  ///< value or sample, without blanks around it
  };

  /// @throws InputError if the file cannot be read, is no text, or has a line with a colon and no
  /// key.
  explicit DescriptorFile(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  std::span<const Line> descriptors() const { return std::span(lines_).first(descriptors_); }
  std::span<const Line> samples() const { return std::span(lines_).subspan(descriptors_); }

  /// The line of a key; null if there is none, or it is empty or NOVALUE.
  const Line* find(std::string_view key) const;
  /// @throws InputError if there is none.
  const Line& need(std::string_view key) const;
  /// The value of a key as a number. @throws InputError if it is missing, none, or not finite.
  double number(std::string_view key) const;
  /// Of a line, which is a sample or a value. @throws likewise.
  double number(const Line& line) const;

  /// @throws InputError with file and line.
  [[noreturn]] void refuse(const Line& line, const std::string& problem) const;
  /// @throws InputError with the file alone.
  [[noreturn]] void refuse(const std::string& problem) const;

 private:
  std::filesystem::path path_;
  std::vector<Line> lines_;
  std::size_t descriptors_ = 0;
};

}  // namespace flexneck::pipeline
