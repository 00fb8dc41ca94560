// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>
#include <string>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/cli/commands.h"
#include "pipeline/experiments/verification/reference.h"
#include "pipeline/language/document/key_reference.h"
#include "pipeline/language/model/model_file.h"
#include "pipeline/language/study/regulation.h"
#include "pipeline/language/study/study.h"
#include "pipeline/results/report/paper_context.h"

namespace flexneck::pipeline {

namespace {

struct Format {
  std::string name;
  std::string what;
  std::span<const Key> (*keys)();
};

const std::array<Format, 5>& formats() {
  static const std::array<Format, 5> all = {{
      {"study", "Studies: geometry, mesh, modes and experiments", study_keys},
      {"model", "Models for 'flexneck simulate'", model_keys},
      {"reference", "Published figures that results are compared with", reference_keys},
      {"context", "Remarks on the paper for the report", context_keys},
      {"regulation", "Certification tests of regulations", regulation_keys},
  }};
  return all;
}

std::string format_text(const Format& format) {
  return format.name + "  " + format.what + "\n" + tables_text(format.keys());
}

const Key& key_named(std::span<const Key> keys, const std::string& name) {
  std::vector<std::string> names;
  for (const Key& key : keys) names.emplace_back(key.name);
  const Key* const found = find_key(keys, name);
  return found != nullptr ? *found : keys[find_name(names, name, "key")];
}

/// Reference of a kind of file, a table or a key.
/// @param path  "study", "study.case" or "study.case.duration"
std::string reference_of(const std::string& path) {
  std::vector<std::string> formats_names;
  for (const Format& format : formats()) formats_names.push_back(format.name);
  std::size_t dot = path.find('.');
  const Format& format =
      formats().at(find_name(formats_names, path.substr(0, dot), "kind of file"));
  if (dot == std::string::npos) return format_text(format);
  const std::string inside = path.substr(dot + 1);
  std::span<const Key> keys = format.keys();
  for (std::string rest = inside;;) {
    dot = rest.find('.');
    const Key& key = key_named(keys, rest.substr(0, dot));
    if (dot == std::string::npos) return key.keys.empty() ? key_text(key) : table_text(inside, key);
    if (key.keys.empty())
      throw InputError(path + ": '" + std::string(key.name) + "' is a key, not a table");
    keys = key.keys;
    rest = rest.substr(dot + 1);
  }
}

}  // namespace

bool keys_command(const FileInput& input) {
  if (input.files.empty()) {
    for (const Format& format : formats()) input.console.result(format_text(format));
    input.console.result("'flexneck keys study.case' lists the keys of a table");
  }
  for (const std::filesystem::path& path : input.files)
    input.console.result(reference_of(path.string()));
  return true;
}

}  // namespace flexneck::pipeline
