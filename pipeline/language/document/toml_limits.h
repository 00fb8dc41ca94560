// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

#include <toml++/toml.h>

namespace flexneck::pipeline {

/// Maximum of nested brackets, or parts of a dotted key.
inline constexpr std::size_t kMaxNested = 32;

/// Refuses text nested deeper than kMaxNested before it is parsed: each level takes stack in the
/// parser, in every walk over its tables and when they are destroyed.
/// @param place  prefix of the line number in the message, such as the file's name
/// @throws InputError
void check_nesting(const std::string& text, const std::string& place);

/// Refuses keys and texts with control characters (geometry/foundation/printable.h), which escapes
/// such as "\n" produce: they must not control a terminal, picture or page.
/// @throws InputError
void check_texts(const toml::table& table);

}  // namespace flexneck::pipeline
