// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string_view>

#include "geometry/foundation/file_descriptor.h"

namespace flexneck {

/// Locks a temporary folder (flock) as long as the descriptor is open, so that other processes see
/// that it is in use. An empty descriptor if the file system has no locks, or another one holds it.
FileDescriptor hold_folder(const std::filesystem::path& folder);

/// Removes the folders that processes which were killed have left in `parent`: those of the user
/// whose name has the prefix, which nobody holds and which are older than an hour.
void remove_abandoned(const std::filesystem::path& parent, std::string_view prefix);

}  // namespace flexneck
