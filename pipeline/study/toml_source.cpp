// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/study/toml_source.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "geometry/foundation/error.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

/// Moves what `over` holds into `base`; tables are merged key by key, everything else replaced.
/// Nodes are moved because a copy would lose its line and column.
void merge(toml::table& base, toml::table&& over) {
  for (auto&& [name, node] : over) {
    const std::string key(name.str());
    toml::table* const below = base[key].as_table();
    if (below != nullptr && node.is_table() && !node.as_table()->is_inline()) {
      merge(*below, std::move(*node.as_table()));
    } else {
      node.visit([&](auto& value) { base.insert_or_assign(key, std::move(value)); });
    }
  }
}

std::string read_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code ignored;
  if (!file || !fs::is_regular_file(path, ignored)) {
    throw InputError(path.string() + ": expected a study file (TOML), found none that can be read");
  }
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

toml::table parse(const fs::path& path, const std::string& text) {
  try {
    return toml::parse(text, path.string());
  } catch (const toml::parse_error& error) {
    std::ostringstream message;
    message << path.string() << ":" << error.source().begin.line << ":"
            << error.source().begin.column << ": this is not TOML: " << error.description();
    throw InputError(message.str());
  }
}

toml::table parse_file(const fs::path& path, std::vector<InputFile>& files,
                       std::vector<fs::path>& open) {
  const fs::path canonical = fs::weakly_canonical(path);
  if (std::find(open.begin(), open.end(), canonical) != open.end()) {
    throw InputError(path.string() + ": includes itself; remove one of the include lines");
  }
  open.push_back(canonical);
  const std::string text = read_text(path);
  toml::table own = parse(path, text);
  toml::table merged;
  if (toml::node* const include = own.get("include")) {
    if (!include->is_array() || !include->as_array()->is_homogeneous<std::string>()) {
      throw InputError(location_of(*include) + "include: expected a list of file names");
    }
    for (const toml::node& name : *include->as_array()) {
      merge(merged, parse_file(path.parent_path() / name.value_or(std::string()), files, open));
    }
    own.erase("include");
  }
  merge(merged, std::move(own));
  files.push_back({path.filename().string(), hash_of_text(text)});
  open.pop_back();
  return merged;
}

/// The value as TOML if it parses as such, else as a plain string: shells strip quotes.
void assign(toml::table& table, const std::string& key, const std::string& text) {
  try {
    toml::table parsed = toml::parse("value = " + text);
    parsed.get("value")->visit([&](auto& value) { table.insert_or_assign(key, std::move(value)); });
  } catch (const toml::parse_error&) {
    table.insert_or_assign(key, text);
  }
}

/// The element of an array of tables whose name is given.
toml::table* element_named(toml::array& array, const std::string& name) {
  for (toml::node& node : array) {
    toml::table* const table = node.as_table();
    if (table != nullptr && (*table)["name"].value_or(std::string()) == name) return table;
  }
  return nullptr;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

}  // namespace

toml::table parse_with_includes(const fs::path& path, std::vector<InputFile>& files) {
  std::vector<fs::path> open;
  return parse_file(path, files, open);
}

void apply_setting(toml::table& root, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  const std::vector<std::string> path = split(setting.substr(0, equals), '.');
  if (equals == std::string::npos || path.empty()) {
    throw InputError("--set " + setting + ": expected key=value");
  }
  toml::table* table = &root;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (toml::array* const array = (*table)[path[i]].as_array(); array != nullptr) {
      table = element_named(*array, path[i + 1]);
      if (table == nullptr || i + 2 >= path.size()) {
        throw InputError("--set " + setting + ": there is no " + path[i] + " named '" +
                         path[i + 1] + "', or no key after it");
      }
      ++i;
      continue;
    }
    toml::table* next = (*table)[path[i]].as_table();
    if (next == nullptr) {
      table->insert_or_assign(path[i], toml::table());
      next = (*table)[path[i]].as_table();
    }
    table = next;
  }
  // The old origin and note do not hold for a new value.
  assign(*table, path.back(), setting.substr(equals + 1));
}

std::string location_of(const toml::node& node) {
  const toml::source_region& source = node.source();
  if (!source.path) return "command line: ";
  std::ostringstream text;
  text << *source.path << ":" << source.begin.line << ":" << source.begin.column << ": ";
  return text.str();
}

}  // namespace flexneck::pipeline
