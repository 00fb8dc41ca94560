// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace flexneck {

/// Reads a text file that people write: UTF-8, without its byte order mark, with tabs and line ends
/// as the only control characters.
/// @throws InputError if the file cannot be read, is not a regular file or has more than
/// `max_bytes`, and with the line of the first character that is not allowed.
std::string read_text(const std::filesystem::path& path, std::size_t max_bytes);

/// The text without UTF-8's byte order mark at the beginning.
std::string without_mark(std::string text);

/// Reads a text file of a program that may not know UTF-8. Bytes that are not UTF-8 are taken for
/// Windows-1252, which contains the printable characters of ISO-8859-1, and are returned as UTF-8.
/// @throws InputError as read_text() does.
std::string read_encoded_text(const std::filesystem::path& path, std::size_t max_bytes);

}  // namespace flexneck
