// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace flexneck {

/// Wall-clock time that this process has spent so far, in all its threads, on hashing and syncing
/// files.
struct FileSeconds {
  double hash = 0;  ///< hashing contents that are written or read
  double sync = 0;  ///< waiting until written content is on the disk
};
FileSeconds file_seconds();

/// Adds the time of its scope.
class FileClock {
 public:
  enum class Work { hash, sync };
  explicit FileClock(Work work) : work_(work) {}
  ~FileClock();
  FileClock(const FileClock&) = delete;
  FileClock& operator=(const FileClock&) = delete;

 private:
  Work work_;
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};

}  // namespace flexneck
