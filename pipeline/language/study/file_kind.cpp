// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/file_kind.h"

#include "geometry/foundation/error.h"
#include "mesher/exchange/foreign_file.h"
#include "pipeline/language/document/toml_source.h"
#include "pipeline/language/model/model_file.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

FileKind kind_of_file(const std::filesystem::path& path) {
  std::vector<InputFile> files;
  const toml::table root = parse_with_includes(path, files);
  for (const auto& [key, node] : root)
    if (find_key(study_keys(), std::string(key.str())) != nullptr &&
        find_key(model_keys(), std::string(key.str())) == nullptr)
      return FileKind::study;
  return root.contains("body") ? FileKind::model : FileKind::study;
}

namespace {

bool is_mesh_or_shape(const std::filesystem::path& path) {
  try {
    mesher::foreign_format_of(path);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

void refuse_other_kind(const std::filesystem::path& path, FileKind expected) {
  if (std::filesystem::is_regular_file(path) && is_mesh_or_shape(path)) {
    const std::string name = path.filename().string();
    throw InputError(path.string() +
                     ": expected a study, found a mesh or shape file, by its extension; write a "
                     "study, such as my.toml, with file = \"" +
                     name + "\" in [geometry] ('flexneck keys study.geometry'), and run it");
  }
  if (kind_of_file(path) == expected) return;
  const bool is_model = expected == FileKind::study;
  throw InputError(path.string() + ": expected a " + (is_model ? "study" : "model") + ", found a " +
                   (is_model ? "model" : "study") + "; try 'flexneck " +
                   (is_model ? "simulate " : "run ") + path.string() + "'");
}

}  // namespace flexneck::pipeline
