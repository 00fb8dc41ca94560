// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/output_file.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <utility>

#include "geometry/foundation/error.h"

namespace flexneck {

OutputFile::OutputFile(std::filesystem::path path)
    : path_(std::move(path)),
      temporary_(path_.string() + ".part"),
      stream_(temporary_, std::ios::binary) {
  if (!stream_) throw InputError(path_.string() + ": cannot be written");
}

OutputFile::~OutputFile() {
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void OutputFile::commit() {
  stream_.close();
  std::error_code error;
  if (stream_) std::filesystem::rename(temporary_, path_, error);
  if (!stream_ || error) throw ComputationError(path_.string() + ": writing failed");
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

std::string exact_text(double number) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
  return {text.data(), end};
}

std::string text_within(double number, int width) {
  std::array<char, 40> text{};
  for (int digits = 17; digits > 0; --digits) {
    const int length = std::snprintf(text.data(), text.size(), "%.*g", digits, number);
    if (length <= width) break;
  }
  return text.data();
}

}  // namespace flexneck
