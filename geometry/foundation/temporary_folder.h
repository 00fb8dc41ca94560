// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/signal_cleanup.h"

namespace flexneck {

/// A fresh folder of ours alone. It goes with all it holds at the end of the scope, and if a signal
/// ends the process (signal_cleanup.h).
class TemporaryFolder {
 public:
  /// @throws InputError if the folder for temporary files that TMPDIR names is none;
  /// ComputationError if it takes no other.
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
