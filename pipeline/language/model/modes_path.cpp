// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/modes_path.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

fs::path modes_path(const StudyTable& table, const std::string& key) {
  fs::path path = table.file(key);
  const std::string made_by = table.has("made_by") ? table.text("made_by") : "";
  std::error_code none;
  if (fs::exists(path, none)) return path;
  fs::path here = path.lexically_relative(table.folder_of(key));
  if (!here.empty() && fs::exists(here, none)) return here;
  // A file set on the command line is not the one that `made_by` describes.
  if (made_by.empty() || table.folder_of("made_by") != table.folder_of(key)) return path;
  table.refuse(key, path.lexically_normal().string() +
                        ": no such file, and none in the current folder; make " +
                        (here.empty() ? path : here).string() + " with '" + made_by + "'");
}

}  // namespace flexneck::pipeline
