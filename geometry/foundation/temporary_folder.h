// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/file_descriptor.h"
#include "geometry/foundation/signal_cleanup.h"

namespace flexneck {

/// A new folder for this object alone. It is removed with all its contents at the end of the scope,
/// and if a signal ends the process (signal_cleanup.h). What a killed process has left behind, a
/// later one removes (held_folder.h).
class TemporaryFolder {
 public:
  /// @throws InputError if TMPDIR names no folder for temporary files; ComputationError if no new
  /// folder can be created in it.
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  FileDescriptor held_;
  SignalCleanup cleanup_;
};

}  // namespace flexneck
