// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace flexneck {

/// A file that is written under a temporary name beside its own and renamed by commit(); without
/// commit() nothing is left.
class OutputFile {
 public:
  /// @throws InputError if the folder cannot be written.
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text) {
    stream_.write(text.data(), static_cast<std::streamsize>(text.size()));
  }
  /// @throws ComputationError if writing has failed.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::ofstream stream_;
};

/// A whole file at once. @throws as OutputFile does.
void write_text(const std::filesystem::path& path, std::string_view text);

/// The shortest text that reads back as the same number.
std::string exact_text(double number);
/// The most exact text of at most `width` characters.
std::string text_within(double number, int width);

}  // namespace flexneck
