// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace flexneck {

// Unprintable characters are those that a reader cannot see and a terminal or another program may
// obey: control characters (C0, delete, C1), separators of lines and paragraphs, marks that change
// the direction of writing, and bytes that are not UTF-8. `kept` lists control characters that are
// allowed all the same.

/// Position of the first unprintable byte; npos if there is none.
std::size_t find_unprintable(std::string_view text, std::string_view kept = {});

/// The text with its unprintable characters escaped, such as \n, \x1b or \u202e.
std::string printable(std::string_view text, std::string_view kept = {});

}  // namespace flexneck
