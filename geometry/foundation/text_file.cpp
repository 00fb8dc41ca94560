// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/text_file.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "geometry/foundation/error.h"
#include "geometry/foundation/input_file.h"
#include "geometry/foundation/printable.h"

namespace flexneck {

namespace {

std::string contents_of(const std::filesystem::path& path, std::size_t max_bytes) {
  const FileDescriptor file = open_to_read(path);
  std::array<char, 1 << 16> block{};
  std::string text;
  for (;;) {
    const std::size_t count = read_at(file, text.size(), block, path);
    text.append(block.data(), count);
    if (text.size() > max_bytes) {
      throw InputError(path.string() + ": expected at most " + std::to_string(max_bytes >> 10U) +
                       " KiB of text, found more");
    }
    if (count < block.size()) return text;
  }
}

constexpr std::string_view kKept = "\t\n\r";

void require_printable(const std::filesystem::path& path, const std::string& text) {
  const std::size_t place = find_unprintable(text, kKept);
  if (place == std::string::npos) return;
  const auto line =
      std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(place), '\n');
  throw InputError(path.string() + ":" + std::to_string(line + 1) +
                   ": expected UTF-8 without control characters, found " +
                   printable(text.substr(place, 1)));
}

/// UTF-8 of the bytes 0x80 to 0x9F of Windows-1252; its five undefined bytes are kept.
constexpr std::array<std::string_view, 32> kWindows1252 = {
    "\u20AC", "\x81",   "\u201A", "\u0192", "\u201E", "\u2026", "\u2020", "\u2021",
    "\u02C6", "\u2030", "\u0160", "\u2039", "\u0152", "\x8D",   "\u017D", "\x8F",
    "\x90",   "\u2018", "\u2019", "\u201C", "\u201D", "\u2022", "\u2013", "\u2014",
    "\u02DC", "\u2122", "\u0161", "\u203A", "\u0153", "\x9D",   "\u017E", "\u0178"};

std::string from_windows_1252(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x80) {
      text += c;
    } else if (code < 0xA0) {
      text += kWindows1252.at(code - 0x80U);
    } else {
      text += static_cast<char>(0xC0U | code >> 6U);
      text += static_cast<char>(0x80U | (code & 0x3FU));
    }
  }
  return text;
}

}  // namespace

std::string without_mark(std::string text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

std::string read_text(const std::filesystem::path& path, std::size_t max_bytes) {
  std::string text = without_mark(contents_of(path, max_bytes));
  require_printable(path, text);
  return text;
}

std::string read_encoded_text(const std::filesystem::path& path, std::size_t max_bytes) {
  std::string text = without_mark(contents_of(path, max_bytes));
  if (find_unprintable(text, kKept) == std::string::npos) return text;
  text = from_windows_1252(text);
  require_printable(path, text);
  return text;
}

}  // namespace flexneck
