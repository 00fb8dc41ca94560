// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/parameter_studies/sampling/files_now.h"

namespace flexneck::pipeline {

bool FilesNow::is_same(const FileRead& file) {
  if (is_unknown_here(file.hash)) return true;
  const auto [known, is_new] = hashes_.try_emplace(file.path);
  if (is_new) known->second = hash_now(file.path);
  return known->second == file.hash;
}

std::vector<FileRead> FilesNow::files() const {
  std::vector<FileRead> files;
  files.reserve(hashes_.size());
  for (const auto& [path, hash] : hashes_) files.push_back({path, hash});
  return files;
}

}  // namespace flexneck::pipeline
