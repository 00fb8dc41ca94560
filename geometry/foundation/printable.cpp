// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/printable.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>

namespace flexneck {

namespace {

constexpr std::uint32_t kNotUtf8 = 0xFFFFFFFF;

struct Character {
  std::uint32_t code = kNotUtf8;
  std::size_t size = 1;  ///< in bytes
};

/// The first character of a text; one byte that is not UTF-8 if the text begins with no valid one.
Character first_of(std::string_view text) {
  const auto byte = [&](std::size_t k) { return static_cast<std::uint8_t>(text[k]); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || size > text.size()) return {};
  std::uint32_t code = lead & (0x7FU >> size);
  for (std::size_t k = 1; k < size; ++k) {
    if ((byte(k) & 0xC0U) != 0x80) return {};
    code = code << 6U | (byte(k) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> kLeastCode = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kLeastCode.at(size) || code > 0x10FFFF || is_surrogate) return {};
  return {code, size};
}

bool is_unprintable(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x061C ||
         (code >= 0x200E && code <= 0x200F) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069) || code == 0xFEFF || code == kNotUtf8;
}

std::string spelt(const Character& character, std::string_view bytes) {
  if (bytes == "\n") return "\\n";
  if (bytes == "\t") return "\\t";
  if (bytes == "\r") return "\\r";
  std::array<char, 8> digits{};
  const bool is_byte = bytes.size() == 1;
  const std::uint32_t code = is_byte ? static_cast<std::uint8_t>(bytes[0]) : character.code;
  std::snprintf(digits.data(), digits.size(), is_byte ? "\\x%02x" : "\\u%04x", code);
  return digits.data();
}

}  // namespace

std::size_t find_unprintable(std::string_view text, std::string_view kept) {
  for (std::size_t place = 0; place < text.size();) {
    const Character character = first_of(text.substr(place));
    if (is_unprintable(character.code) && kept.find(text[place]) == std::string_view::npos)
      return place;
    place += character.size;
  }
  return std::string_view::npos;
}

std::string printable(std::string_view text, std::string_view kept) {
  std::string shown;
  shown.reserve(text.size());
  while (!text.empty()) {
    const std::size_t clean = std::min(find_unprintable(text, kept), text.size());
    shown += text.substr(0, clean);
    text.remove_prefix(clean);
    if (text.empty()) break;
    const Character character = first_of(text);
    shown += spelt(character, text.substr(0, character.size));
    text.remove_prefix(character.size);
  }
  return shown;
}

}  // namespace flexneck
