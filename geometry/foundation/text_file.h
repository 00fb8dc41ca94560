// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace flexneck {

/// A file that people write: UTF-8, whose mark at the beginning is taken away, with tabs and line
/// ends as the only control characters.
/// @throws InputError for a file that cannot be read, is no regular one or has more than
/// `max_bytes`, and with the line of the first character that does not belong there.
std::string read_text(const std::filesystem::path& path, std::size_t max_bytes);

/// Without UTF-8's mark at the beginning.
std::string without_mark(std::string text);

/// A file of programs that may not know UTF-8. What is not UTF-8 is taken for Windows-1252, of
/// whose printable characters those of ISO-8859-1 are a part, and comes back as UTF-8.
/// @throws InputError as read_text() does.
std::string read_encoded_text(const std::filesystem::path& path, std::size_t max_bytes);

}  // namespace flexneck
