// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace flexneck {

class FileDescriptor;

/// 128-bit XXH3 hash, 32 hexadecimal digits.
std::string hash_of_text(const std::string& text);
/// Hash of a file's content; for an HDF5 file of this program, the hash that it carries and its
/// reader checks.
/// @throws as open_to_read() and read_at() do.
std::string hash_of_file(const std::string& path);

/// HDF5 files of this program begin with a block, before the first byte of HDF5, that holds the
/// hash of all that follows: the text "flexneck, XXH3-128 of all after 512 bytes: " with its 32
/// digits, a line break and zeros.
inline constexpr std::size_t kHashBlockSize = 512;
using HashBlock = std::array<char, kHashBlockSize>;

/// The hash block of a file, computed from the content that follows it.
/// @throws ComputationError if the file cannot be read.
HashBlock hash_block_of(const FileDescriptor& file, const std::filesystem::path& path);

/// The unchecked hash that a file of this program carries; none if the file is foreign.
/// @throws InputError or ComputationError if the file cannot be read.
std::optional<std::string> carried_hash(const std::filesystem::path& path);

/// Hash computed from every byte of the file's content. It differs from hash_of_file() if a file of
/// this program is damaged.
std::string computed_hash_of_file(const std::filesystem::path& path);

/// Trust in a file's content before any library parses it.
enum class Trust {
  verified,  ///< every byte is as this program wrote it
  foreign    ///< it has no hash block: all its content has to be checked
};

/// Checks the hash of a file.
/// @param remedy ends the message, such as "make it again with 'flexneck mesh'"
/// @throws InputError if the file cannot be read, or has a hash block that does not fit its
/// content.
Trust trust_of(const std::filesystem::path& path, const std::string& remedy = "make it again");

}  // namespace flexneck
