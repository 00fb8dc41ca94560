// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/output_file.h"

#include <array>
#include <charconv>
#include <cstdio>

namespace flexneck {

void OutputFile::write_waiting() {
  file_.write_at(written_, waiting_);
  file_.require_written();
  written_ += waiting_.size();
  waiting_.clear();
}

void OutputFile::commit(Durability durability) {
  write_waiting();
  file_.commit(durability);
}

void write_text(const std::filesystem::path& path, std::string_view text, Durability durability) {
  OutputFile file(path);
  file.write(text);
  file.commit(durability);
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
