// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/signal_cleanup.h"

namespace flexneck {

/// A new folder for this object alone. It is removed with all its contents at the end of the scope,
/// and if a signal ends the process (signal_cleanup.h).
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
  SignalCleanup cleanup_;
};

}  // namespace flexneck
