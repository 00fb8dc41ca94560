// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace flexneck::pipeline {

/// That a line of a table or a text on standard output has at most.
inline constexpr std::size_t kConsoleColumns = 100;

/// Characters as they appear: the continuation bytes of UTF-8 take no room.
std::size_t width_of(const std::string& text);

/// The lines of a text, which is broken only where it is wider: between words, and within words
/// that are wider by themselves; one line at least.
std::vector<std::string> wrapped_lines(const std::string& text, std::size_t width);

/// The same behind a margin, to the width of the console; every line ends in a line break.
std::string wrapped(const std::string& text, const std::string& margin);

}  // namespace flexneck::pipeline
