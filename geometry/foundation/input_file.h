// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "geometry/foundation/file_descriptor.h"

namespace flexneck {

/// Opens a regular file for reading and notes it (files_read.h). A pipe is refused instead of
/// waiting for its writer.
/// @throws InputError if there is no such file, it is of another kind or may not be read
/// @throws ComputationError if the system fails
FileDescriptor open_to_read(const std::filesystem::path& path);

/// Fills `block` from a place on; returns fewer bytes only at the end of the file.
/// @return the number of bytes read
/// @throws ComputationError if the system fails
std::size_t read_at(const FileDescriptor& file, std::uint64_t place, std::span<char> block,
                    const std::filesystem::path& path);

/// Content of a whole file.
/// @throws as open_to_read() and read_at() do.
std::string text_of_file(const std::filesystem::path& path);

}  // namespace flexneck
