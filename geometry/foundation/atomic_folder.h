// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/file_descriptor.h"
#include "geometry/foundation/signal_cleanup.h"

namespace flexneck {

/// A folder of files that belong together and appear whole or not at all. They are written into a
/// hidden folder beside it, which only a killed process leaves behind until a later one writes
/// there (held_folder.h).
class AtomicFolder {
 public:
  /// @throws InputError if the parent folder does not exist or cannot be written.
  explicit AtomicFolder(std::filesystem::path path);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return temporary_ / name; }

  /// Moves the folder to its place; an existing one is removed with all its contents.
  /// @throws ComputationError if that fails; an existing folder is then still there.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;  ///< empty once the folder is in its place
  FileDescriptor held_;
  SignalCleanup cleanup_;
};

}  // namespace flexneck
