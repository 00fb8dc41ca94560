// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace flexneck::pipeline {

/// Maximum width of tables and texts on standard output.
inline constexpr std::size_t kConsoleColumns = 100;

/// Number of visible characters: the continuation bytes of UTF-8 take no room.
std::size_t width_of(const std::string& text);

/// Splits a text into lines of at most `width`: between words, and within words that are wider;
/// returns at least one line.
std::vector<std::string> wrapped_lines(const std::string& text, std::size_t width);

/// Text wrapped to the width of the console behind a margin; every line ends in a line break.
std::string wrapped(const std::string& text, const std::string& margin);

}  // namespace flexneck::pipeline
