// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/temporary_folder.h"

#include <cstdlib>
#include <stdlib.h>  // mkdtemp is POSIX
#include <system_error>

#include "geometry/foundation/error.h"
#include "geometry/foundation/files_read.h"

namespace flexneck {

namespace fs = std::filesystem;

namespace {

fs::path folder_for_temporary_files() {
  std::error_code failure;
  fs::path folder = fs::temp_directory_path(failure);
  if (!failure) return folder;
  const char* const given = std::getenv("TMPDIR");
  throw InputError(std::string("TMPDIR: expected a folder for temporary files, found '") +
                   (given != nullptr ? given : "") + "'; set it to one, or leave it out");
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (folder_for_temporary_files() / "flexneck-XXXXXX").string();
  const SignalHold hold;
  if (mkdtemp(name.data()) == nullptr) {
    throw ComputationError(name + ": a temporary folder cannot be made");
  }
  path_ = name;
  cleanup_ = SignalCleanup(SignalCleanup::Action::remove_folder, path_);
}

TemporaryFolder::~TemporaryFolder() {
  forget_reads_in(path_);
  remove_folder(path_);
}

}  // namespace flexneck
