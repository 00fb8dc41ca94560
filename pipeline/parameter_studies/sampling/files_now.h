// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "geometry/foundation/files_read.h"

namespace flexneck::pipeline {

/// Checks whether files are unchanged since they were read. Each is examined once, so that all
/// answers of one object refer to one state.
class FilesNow {
 public:
  bool is_same(const FileRead& file);
  /// All files examined, in their current state.
  std::vector<FileRead> files() const;

 private:
  std::map<std::string, std::string> hashes_;  ///< by path
};

}  // namespace flexneck::pipeline
