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
/// Of a file's content; of an HDF5 file of ours, the one that it carries and its reader checks.
/// @throws as open_to_read() and read_at() do.
std::string hash_of_file(const std::string& path);

/// Our HDF5 files begin with a block, before the first byte of HDF5, that holds the hash of all
/// that follows: the text "flexneck, XXH3-128 of all after 512 bytes: " with its 32 digits, a line
/// break and zeros.
inline constexpr std::size_t kHashBlockSize = 512;
using HashBlock = std::array<char, kHashBlockSize>;

/// The block that belongs to what stands in a file behind it.
/// @throws ComputationError if the file cannot be read.
HashBlock hash_block_of(const FileDescriptor& file, const std::filesystem::path& path);

/// The hash that a file of ours carries, unchecked; none if the file is foreign.
/// @throws InputError or ComputationError if the file cannot be read.
std::optional<std::string> carried_hash(const std::filesystem::path& path);

/// As hash_of_file(), but of every byte that is there: not the same if a file of ours is damaged.
std::string computed_hash_of_file(const std::filesystem::path& path);

/// What is known of a file before any library parses it.
enum class Trust {
  verified,  ///< every byte is as we wrote it
  foreign    ///< it has no block of ours: whatever it holds is to be checked
};

/// @param remedy ends the message, such as "make it again with 'flexneck mesh'"
/// @throws InputError if the file cannot be read, or has a block of ours and another content.
Trust trust_of(const std::filesystem::path& path, const std::string& remedy = "make it again");

}  // namespace flexneck
