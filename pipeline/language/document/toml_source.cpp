// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/toml_source.h"

#include <algorithm>
#include <locale>
#include <sstream>

#include "geometry/foundation/error.h"
#include "geometry/foundation/printable.h"
#include "geometry/foundation/text_file.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/language/document/toml_limits.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

/// Maximum size of a file; long lists belong in CSV files.
constexpr std::size_t kMaxBytes = 4U << 20U;

void merge(toml::table& base, toml::table&& over);

/// The element of an array of tables that `over` overrides: the one of the same name and, where
/// both give it, the same body, as for markers.
toml::table* counterpart(toml::array& array, const toml::table& over) {
  const auto text = [](const toml::table& table, const char* key) {
    const toml::node* node = table.get(key);
    if (node != nullptr && node->is_table()) node = node->as_table()->get("value");
    return node == nullptr ? std::string() : node->value_or(std::string());
  };
  const std::string name = text(over, "name");
  const std::string body = text(over, "body");
  for (toml::node& node : array) {
    toml::table* const table = node.as_table();
    const std::string its_body = text(*table, "body");
    if (text(*table, "name") == name && (body.empty() || its_body.empty() || body == its_body))
      return table;
  }
  return nullptr;
}

/// Keys that a table removes from the one below it, by an empty list.
std::vector<std::string> emptied_keys(const toml::table& over) {
  std::vector<std::string> keys;
  for (const auto& [key, node] : over)
    if (node.is_array() && node.as_array()->empty()) keys.emplace_back(key.str());
  return keys;
}

/// True if the tables of an array can be told apart by their names.
bool has_names(const toml::array& array) {
  return array.is_array_of_tables() &&
         std::all_of(array.begin(), array.end(),
                     [](const auto& node) { return node.as_table()->contains("name"); });
}

void merge(toml::array& base, toml::array&& over) {
  for (toml::node& node : over) {
    toml::table& table = *node.as_table();
    toml::table* const below = counterpart(base, table);
    if (below == nullptr) {
      base.push_back(std::move(table));
      continue;
    }
    for (const std::string& key : emptied_keys(table)) {
      below->erase(key);
      table.erase(key);
    }
    merge(*below, std::move(table));
  }
}

/// Moves the content of `over` into `base`: tables are merged key by key, lists of tables with
/// names element by element, and everything else is replaced. An empty list of tables replaces all
/// of them; in a table with a name an empty list removes the key. Nodes are moved because a copy
/// would lose its line and column.
void merge(toml::table& base, toml::table&& over) {
  for (auto&& [name, node] : over) {
    const std::string key(name.str());
    toml::node* const below = base.get(key);
    toml::table* const table = below == nullptr ? nullptr : below->as_table();
    toml::array* const list = below == nullptr ? nullptr : below->as_array();
    if (table != nullptr && node.is_table() && !node.as_table()->is_inline()) {
      merge(*table, std::move(*node.as_table()));
    } else if (list != nullptr && node.is_array() && has_names(*list) &&
               has_names(*node.as_array())) {
      merge(*list, std::move(*node.as_array()));
    } else {
      node.visit([&](auto& value) { base.insert_or_assign(key, std::move(value)); });
    }
  }
}

toml::table parse(const fs::path& path, const std::string& text) {
  try {
    check_nesting(text, path.string());
    toml::table table = toml::parse(text, path.string());
    check_texts(table);
    return table;
  } catch (const toml::parse_error& error) {
    throw InputError(path.string() + ":" + std::to_string(error.source().begin.line) + ":" +
                     std::to_string(error.source().begin.column) +
                     ": invalid TOML: " + std::string(error.description()));
  }
}

/// Reads a file and its includes.
class Reading {
 public:
  explicit Reading(std::vector<InputFile>& files) : files_(files) {}

  toml::table merged(const DocumentSource& source) {
    const fs::path& path = source.path;
    open(path);
    const std::string text = source.text ? *source.text : read_text(path, kMaxBytes);
    toml::table own = parse(path, text);
    toml::table table;
    if (toml::node* const include = own.get("include")) {
      if (!include->is_array() || !include->as_array()->is_homogeneous<std::string>()) {
        throw InputError(location_of(*include) + "include: expected a list of file names");
      }
      for (const toml::node& name : *include->as_array()) {
        merge(table, merged(named_file(name.value_or(std::string()), path.parent_path())));
      }
      own.erase("include");
    }
    // A single table keeps its place in the file, for messages about missing keys.
    if (table.empty()) {
      table = std::move(own);
    } else {
      merge(table, std::move(own));
    }
    files_.push_back({path.filename().string(), hash_of_text(text)});
    open_.pop_back();
    return table;
  }

 private:
  void open(const fs::path& path) {
    std::error_code error;
    const fs::path canonical = fs::weakly_canonical(path, error);
    if (error) throw InputError(path.string() + ": cannot be read (" + error.message() + ")");
    if (std::find(open_.begin(), open_.end(), canonical) != open_.end()) {
      throw InputError(path.string() + ": includes itself; remove one of the include lines");
    }
    if (open_.size() == kDeepestInclude || ++count_ > kMaxFiles) {
      throw InputError(path.string() + ": expected at most " + std::to_string(kMaxFiles) +
                       " included files, nested at most " + std::to_string(kDeepestInclude) +
                       " deep, found more; remove some of the include lines");
    }
    open_.push_back(canonical);
  }

  std::vector<InputFile>& files_;
  std::vector<fs::path> open_;  ///< the file being read and the files that include it
  std::size_t count_ = 0;
};

/// Assigns the value as TOML if it parses as such, else as a plain string, since shells strip
/// quotes.
void assign(toml::table& table, const std::string& key, const std::string& text) {
  try {
    toml::table parsed = toml::parse("value = " + text);
    check_texts(parsed);
    parsed.get("value")->visit([&](auto& value) { table.insert_or_assign(key, std::move(value)); });
  } catch (const toml::parse_error&) {
    table.insert_or_assign(key, text);
  }
}

/// The element of an array of tables with a given name.
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

toml::table parse_with_includes(const DocumentSource& source, std::vector<InputFile>& files) {
  return Reading(files).merged(source);
}

void apply_setting(toml::table& root, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  const std::vector<std::string> path = split(setting.substr(0, equals), '.');
  if (equals == std::string::npos || path.empty()) {
    throw InputError("--set " + setting + ": expected key=value");
  }
  if (find_unprintable(setting) != std::string::npos || path.size() > kMaxNested) {
    throw InputError("--set " + setting + ": expected a key with at most " +
                     std::to_string(kMaxNested) + " parts and without control characters");
  }
  check_nesting(setting.substr(equals + 1), "--set " + setting);
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
  // The old origin and note are not valid for a new value.
  assign(*table, path.back(), setting.substr(equals + 1));
}

std::string toml_text(const toml::node& node) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  node.visit([&](const auto& value) { stream << value; });
  return stream.str();
}

std::string location_of(const toml::node& node) {
  const toml::source_region& source = node.source();
  if (!source.path) return "command line: ";
  return *source.path + ":" + std::to_string(source.begin.line) + ":" +
         std::to_string(source.begin.column) + ": ";
}

}  // namespace flexneck::pipeline
