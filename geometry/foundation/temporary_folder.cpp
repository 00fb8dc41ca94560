// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/temporary_folder.h"

#include <cstdlib>
#include <mutex>
#include <stdlib.h>  // mkdtemp is POSIX
#include <system_error>

#include "geometry/foundation/error.h"
#include "geometry/foundation/files_read.h"
#include "geometry/foundation/held_folder.h"

namespace flexneck {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPrefix = "flexneck-";

fs::path folder_for_temporary_files() {
  std::error_code failure;
  fs::path folder = fs::temp_directory_path(failure);
  if (!failure) return folder;
  const char* const given = std::getenv("TMPDIR");
  throw InputError(std::string("TMPDIR: expected a folder for temporary files, found '") +
                   (given != nullptr ? given : "") + "'; set it to a folder, or unset it");
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  const fs::path parent = folder_for_temporary_files();
  static std::once_flag once;
  std::call_once(once, [&] { remove_abandoned(parent, kPrefix); });
  std::string name = (parent / kPrefix).string() + "XXXXXX";
  const SignalHold hold;
  if (mkdtemp(name.data()) == nullptr) {
    throw ComputationError(name + ": a temporary folder cannot be created");
  }
  path_ = name;
  held_ = hold_folder(path_);
  cleanup_ = SignalCleanup(SignalCleanup::Action::remove, path_);
}

TemporaryFolder::~TemporaryFolder() {
  forget_reads_in(path_);
  remove_whole(path_);
}

}  // namespace flexneck
