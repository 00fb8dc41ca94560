// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "geometry/foundation/files_read.h"

namespace flexneck::pipeline {

/// Tells whether files are still as they were when they were read. Each is looked at once, so that
/// all that one object calls the same is of one state.
class FilesNow {
 public:
  bool is_same(const FileRead& file);
  /// All that were looked at, as they are.
  std::vector<FileRead> files() const;

 private:
  std::map<std::string, std::string> hashes_;  ///< by path
};

}  // namespace flexneck::pipeline
