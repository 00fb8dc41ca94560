// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/atomic_folder.h"

#include <cstring>
#include <fcntl.h>
#include <stdio.h>  // renameat2 is specific to Linux
#include <sys/stat.h>
#include <utility>

#include "geometry/foundation/atomic_file.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/fresh_name.h"
#include "geometry/foundation/held_folder.h"

namespace flexneck {

namespace fs = std::filesystem;

namespace {

constexpr mode_t kPermissions = 0777;  ///< masked by the user's umask

fs::path parent_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

AtomicFolder::AtomicFolder(fs::path path) : path_(std::move(path)) {
  remove_abandoned(parent_of(path_), kFreshPrefix);
  const SignalHold hold;
  temporary_ = take_fresh_name(parent_of(path_), [](const fs::path& name) {
    return ::mkdir(name.c_str(), kPermissions) == 0;
  });
  if (temporary_.empty())
    throw InputError(path_.string() + ": cannot be written (" + std::strerror(errno) +
                     "); choose another folder");
  held_ = hold_folder(temporary_);
  cleanup_ = SignalCleanup(SignalCleanup::Action::remove, temporary_);
}

AtomicFolder::~AtomicFolder() {
  if (!temporary_.empty()) remove_whole(temporary_);
}

void AtomicFolder::commit() {
  const auto take_place = [&](unsigned flags) {
    return ::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, path_.c_str(), flags) == 0;
  };
  sync_folder(temporary_);
  const SignalHold hold;
  if (take_place(0)) {  // if no folder is there, or an empty one
    temporary_.clear();
  } else if (!take_place(RENAME_EXCHANGE)) {
    throw ComputationError(path_.string() + ": cannot be written (" + std::strerror(errno) +
                           "); remove the existing folder, or choose another one");
  }
  if (!temporary_.empty()) remove_whole(std::exchange(temporary_, {}));
  cleanup_.reset();
  sync_folder(parent_of(path_));
}

}  // namespace flexneck
