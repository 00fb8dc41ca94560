// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/file_descriptor.h"
#include "geometry/foundation/progress.h"
#include "geometry/foundation/signal_cleanup.h"

namespace flexneck::pipeline {

/// Keeps a folder of results for one command. Others read it meanwhile: each file in it is whole.
/// The lock is the system's on the file ".flexneck.lock", which says who holds it; it ends with the
/// process, however that ends.
class FolderLock {
 public:
  /// Makes the folder if there is none.
  /// @param command as the user gave it, for whoever finds the folder locked
  /// @param warn is told if the file system has no locks; then there is none
  /// @throws InputError if the folder cannot be made or written, or another command holds it.
  FolderLock(std::filesystem::path folder, const std::string& command, const Progress& warn);
  /// A folder that was made for the lock and got nothing goes, too.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  void open();
  void take();
  void release() noexcept;
  std::string holder() const;
  bool is_in_place() const;
  void sign(const std::string& command) const;
  [[noreturn]] void refuse(const std::string& problem) const;

  std::filesystem::path folder_;
  std::filesystem::path path_;
  FileDescriptor file_;
  bool is_made_ = false;   ///< the folder, by this
  bool is_fixed_ = false;  ///< the lock, by this
  SignalCleanup lock_cleanup_;
  SignalCleanup folder_cleanup_;
};

}  // namespace flexneck::pipeline
