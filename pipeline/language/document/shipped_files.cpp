// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/shipped_files.h"

#include <algorithm>
#include <array>
#include <map>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/running_object.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFolder = "share/flexneck";
constexpr const char* kEnding = ".toml";

/// Folders of the studies and models that can be named without a path.
constexpr std::array<const char*, 4> kNamedFolders = {"pipeline/data/studies",
                                                      "pipeline/data/studies/fits",
                                                      "pipeline/data/models", "geometry/examples"};

fs::path found(const fs::path& name) {
  const fs::path program = running_object();
  for (fs::path at = program.parent_path();; at = at.parent_path()) {
    if (fs::exists(at / name)) return fs::canonical(at / name);
    if (at == at.root_path()) break;
  }
  throw ComputationError(program.string() + ": there is no " + name.string() +
                         " beside or above it; reinstall flexneck");
}

const std::map<std::string, fs::path>& named_files() {
  static const std::map<std::string, fs::path> files = [] {
    std::map<std::string, fs::path> found;
    for (const char* const folder : kNamedFolders)
      for (const auto& entry : fs::directory_iterator(shipped_file(folder)))
        if (entry.path().extension() == kEnding)
          found.emplace(entry.path().stem().string(), entry.path());
    return found;
  }();
  return files;
}

/// True for anything but a folder, as a folder of results may have the name of its study.
bool is_file(const fs::path& path) {
  std::error_code none;
  const fs::file_status status = fs::status(path, none);
  return fs::exists(status) && !fs::is_directory(status);
}

}  // namespace

fs::path shipped_folder() {
  static const fs::path folder = found(kFolder);
  return folder;
}

fs::path library_file(const std::string& name) { return found(fs::path("lib/flexneck") / name); }

fs::path shipped_file(const fs::path& path) { return shipped_folder() / path; }

std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  for (const auto& [name, path] : named_files()) names.push_back(name);
  return names;
}

fs::path named_file(const fs::path& name, const fs::path& folder) {
  fs::path here = folder / name;
  if (is_file(here)) return here;
  if (name.extension() != kEnding && is_file(here.string() + kEnding))
    return here.string() + kEnding;
  if (name.empty() || name.has_parent_path()) return here;
  const std::string stem = name.extension() == kEnding ? name.stem().string() : name.string();
  const auto shipped = named_files().find(stem);
  if (shipped != named_files().end()) return shipped->second;
  // A folder or an unreadable file: the reader reports the problem.
  std::error_code none;
  if (fs::status(here, none).type() != fs::file_type::not_found) return here;
  throw InputError(here.string() + ": no such file, and there is no shipped study or model '" +
                   stem + "'" + did_you_mean(shipped_names(), stem));
}

}  // namespace flexneck::pipeline
