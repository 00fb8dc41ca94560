// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/output_file.h"

#include <array>
#include <charconv>
#include <limits>

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
  std::string text;
  for (int digits = 17; digits > 0; --digits) {
    text = rounded_text(number, digits);
    if (text.size() <= static_cast<std::size_t>(width)) break;
  }
  return text;
}

std::string rounded_text(double number, int digits) {
  std::array<char, 40> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number,
                                          std::chars_format::general, digits);
  return {text.data(), end};
}

std::string rounded_texts(std::span<const double> numbers, int digits) {
  std::string text;
  for (const double number : numbers)
    text += (text.empty() ? "" : ", ") + rounded_text(number, digits);
  return text;
}

std::string fixed_text(double number, int decimals) {
  constexpr int kOthers = 3;  // sign, decimal point and the digit that max_exponent10 does not
                              // count
  std::string text(
      static_cast<std::size_t>(std::numeric_limits<double>::max_exponent10 + kOthers + decimals),
      '\0');
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number,
                                          std::chars_format::fixed, decimals);
  text.resize(static_cast<std::size_t>(end - text.data()));
  return text;
}

}  // namespace flexneck
