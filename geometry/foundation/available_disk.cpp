// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/available_disk.h"

#include <limits>
#include <sys/statvfs.h>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"

namespace flexneck {

double available_disk(const std::filesystem::path& folder) {
  struct statvfs disk {};
  const bool is_known = ::statvfs(folder.empty() ? "." : folder.c_str(), &disk) == 0;
  // Some network file systems report neither their size nor their free space.
  if (!is_known || disk.f_blocks == 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
}

void require_disk(const std::filesystem::path& folder, const std::string& what, double bytes,
                  const std::string& advice) {
  const double available = available_disk(folder);
  if (bytes <= available) return;
  throw InputError(folder.string() + ": " + what + " needs about " + memory_text(bytes) +
                   " of disk space, but only " + memory_text(available) + " are free; " + advice);
}

}  // namespace flexneck
