// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <charconv>
#include <cmath>
#include <string>

namespace flexneck::fe_modal {

/// Reads a number in Fortran's notation as well: with a plus in front, or a D before its exponent.
/// @return true if the text is a finite number, and nothing else
inline bool read_number(std::string text, double& value) {
  for (char& c : text)
    if (c == 'D' || c == 'd') c = 'e';
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (text.starts_with('+')) ++begin;
  const auto [after, error] = std::from_chars(begin, end, value);
  return error == std::errc() && after == end && std::isfinite(value);
}

}  // namespace flexneck::fe_modal
