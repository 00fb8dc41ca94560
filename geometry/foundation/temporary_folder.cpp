// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/temporary_folder.h"

#include <stdlib.h>  // mkdtemp is POSIX

#include "geometry/foundation/error.h"

namespace flexneck {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "flexneck-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw ComputationError(name + ": a temporary folder cannot be made");
  }
  path_ = name;
  cleanup_ = SignalCleanup(SignalCleanup::Action::remove_folder, path_);
}

TemporaryFolder::~TemporaryFolder() { remove_folder(path_); }

}  // namespace flexneck
