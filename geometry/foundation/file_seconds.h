// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>

namespace flexneck {

/// What the care for files has cost this process so far, all threads, by the clock on the wall:
/// counted for the process, as the system counts its processor time.
struct FileSeconds {
  double hash = 0;  ///< of contents, written and read
  double sync = 0;  ///< until what was written is on the disk
};
FileSeconds file_seconds();

/// Counts the time of its scope.
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
