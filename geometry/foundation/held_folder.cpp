// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/held_folder.h"

#include <ctime>
#include <fcntl.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>

#include "geometry/foundation/signal_cleanup.h"

namespace flexneck {

namespace fs = std::filesystem;

namespace {

/// A process makes a folder and locks it at once: an older one without a lock is abandoned.
constexpr std::time_t kAge_s = 3600;

}  // namespace

FileDescriptor hold_folder(const fs::path& folder) {
  constexpr int kFlags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
  FileDescriptor held(uninterrupted([&] { return ::open(folder.c_str(), kFlags); }));
  if (held && uninterrupted([&] { return ::flock(held.get(), LOCK_EX | LOCK_NB); }) != 0)
    held.close();
  return held;
}

void remove_abandoned(const fs::path& parent, std::string_view prefix) {
  std::error_code failure;
  for (fs::directory_iterator at(parent, failure), end; !failure && at != end;
       at.increment(failure)) {
    if (!at->path().filename().native().starts_with(prefix)) continue;
    const FileDescriptor held = hold_folder(at->path());
    struct stat status {};
    if (held && ::fstat(held.get(), &status) == 0 && status.st_uid == ::geteuid() &&
        status.st_mtime < std::time(nullptr) - kAge_s)
      remove_whole(at->path());
  }
}

}  // namespace flexneck
