// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace flexneck {

// Unprintable is what a reader cannot see and a terminal or another program may obey: control
// characters (C0, delete, C1), separators of lines and paragraphs, marks that turn the direction of
// writing, and bytes that are not UTF-8. `kept` names control characters that are fine all the
// same.

/// Place of the first unprintable byte; npos if there is none.
std::size_t find_unprintable(std::string_view text, std::string_view kept = {});

/// The text with what is unprintable spelt out, such as \n, \x1b or \u202e.
std::string printable(std::string_view text, std::string_view kept = {});

}  // namespace flexneck
