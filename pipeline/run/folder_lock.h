// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "geometry/foundation/file_descriptor.h"
#include "geometry/foundation/progress.h"
#include "geometry/foundation/signal_cleanup.h"

namespace flexneck::pipeline {

/// Locks a folder of results for one command. Others may read it meanwhile: each file in it is
/// complete. The lock is the system's on the file ".flexneck.lock", which names the holder; it ends
/// with the process, however that ends.
class FolderLock {
 public:
  /// Creates the folder if there is none, and locks it.
  /// @param command the command as given, shown to others that find the folder locked
  /// @param warn called if the file system has no locks; then the folder is not locked
  /// @throws InputError if the folder cannot be made or written, or another command holds it.
  FolderLock(std::filesystem::path folder, const std::string& command, const Progress& warn);
  /// Unlocks; removes the folder if it was created for the lock and is still empty.
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
  bool is_made_ = false;   ///< true if this lock created the folder
  bool is_fixed_ = false;  ///< true if this object holds the lock
  SignalCleanup lock_cleanup_;
  SignalCleanup folder_cleanup_;
};

}  // namespace flexneck::pipeline
