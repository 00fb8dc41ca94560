// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace flexneck {

// Character classes of ASCII. C's functions depend on the locale: in a Turkish locale toupper('i')
// is 'i', in an ISO 8859 locale half a character of UTF-8 is a letter.

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

constexpr char upper_case(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

constexpr char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

constexpr bool is_letter(char c) { return lower_case(c) >= 'a' && lower_case(c) <= 'z'; }

constexpr bool is_letter_or_digit(char c) { return is_letter(c) || is_digit(c); }

}  // namespace flexneck
