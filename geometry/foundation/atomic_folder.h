// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/signal_cleanup.h"

namespace flexneck {

/// A folder of files that belong together and appear whole or not at all. They are written into a
/// hidden one beside it, of which only a killed process leaves anything behind.
class AtomicFolder {
 public:
  /// @throws InputError if there is no folder to make it in, or it may not be written.
  explicit AtomicFolder(std::filesystem::path path);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return temporary_ / name; }

  /// Brings the folder to its place; one that is there goes with all that it holds.
  /// @throws ComputationError if that fails; what was in the place before is still there then.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;  ///< empty once it is in its place
  SignalCleanup cleanup_;
};

}  // namespace flexneck
