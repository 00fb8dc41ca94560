// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/document/former_names.h"

#include <utility>

#include "geometry/foundation/error.h"
#include "pipeline/document/toml_source.h"

namespace flexneck::pipeline {

namespace {

class Renaming {
 public:
  Renaming(std::vector<std::string>& warnings) : warnings_(warnings) {}

  void rename(toml::table& table, std::span<const Key> keys, const std::string& path) {
    for (const Key& key : keys) rename_key(table, key, path);
    for (auto&& [name, node] : table) {
      const Key* const key = find_key(keys, name.str());
      if (key == nullptr) continue;
      rename_text(node, *key, path + std::string(name.str()));
      rename_below(node, *key, path + std::string(name.str()) + ".");
    }
  }

 private:
  void warn(const toml::node& node, const std::string& path, std::string_view was,
            std::string_view is) {
    warnings_.push_back(location_of(node) + path + ": '" + std::string(was) + "' is now called '" +
                        std::string(is) + "'");
  }

  void rename_key(toml::table& table, const Key& key, const std::string& path) {
    const std::string_view was = key.details.formerly;
    toml::node* const node = was.empty() ? nullptr : table.get(was);
    if (node == nullptr) return;
    const std::string dotted = path + std::string(was);
    if (table.contains(key.name)) {
      throw InputError(location_of(*node) + dotted + ": is now called '" + std::string(key.name) +
                       "', which is there too; leave one out");
    }
    warn(*node, dotted, was, key.name);
    // Moved, since a copy would lose its line and column.
    node->visit([&](auto& value) { table.insert_or_assign(key.name, std::move(value)); });
    table.erase(was);
  }

  /// Renames a text, plain or labelled with its origin.
  void rename_text(toml::node& node, const Key& key, const std::string& path) {
    if (key.details.former_texts.empty()) return;
    toml::node* const inner = node.is_table() ? node.as_table()->get("value") : &node;
    toml::value<std::string>* const text = inner == nullptr ? nullptr : inner->as_string();
    if (text == nullptr) return;
    for (const FormerText& former : key.details.former_texts) {
      if (text->get() != former.was) continue;
      warn(*text, path, former.was, former.is);
      text->get() = std::string(former.is);
      return;
    }
  }

  void rename_below(toml::node& node, const Key& key, const std::string& path) {
    if (key.keys.empty()) return;
    if (toml::table* const table = node.as_table()) rename(*table, key.keys, path);
    if (toml::array* const tables = node.as_array()) {
      for (toml::node& element : *tables) {
        toml::table* const table = element.as_table();
        if (table != nullptr) rename(*table, key.keys, path);
      }
    }
  }

  std::vector<std::string>& warnings_;
};

/// Row of a key by its current or former name.
const Key* find_any(std::span<const Key> keys, std::string_view name) {
  for (const Key& key : keys)
    if (!key.details.formerly.empty() && key.details.formerly == name) return &key;
  return find_key(keys, name);
}

}  // namespace

void use_current_names(toml::table& table, std::span<const Key> keys, const std::string& path,
                       std::vector<std::string>& warnings) {
  Renaming(warnings).rename(table, keys, path);
}

std::string current_name(const std::string& dotted, std::span<const Key> keys) {
  const std::size_t dot = dotted.find('.');
  const std::string first = dotted.substr(0, dot);
  const Key* const key = find_any(keys, first);
  if (key == nullptr) return dotted;
  const std::string name = key->name == "*" ? first : std::string(key->name);
  if (dot == std::string::npos) return name;
  std::string rest = dotted.substr(dot + 1);
  if (key->type == KeyType::table) return name + "." + current_name(rest, key->keys);
  // An element's name may contain dots; its keys are at the end.
  const std::size_t last = rest.rfind('.');
  if (last == std::string::npos) return name + "." + rest;
  return name + "." + rest.substr(0, last + 1) + current_name(rest.substr(last + 1), key->keys);
}

std::string with_current_names(const std::string& setting, std::span<const Key> keys,
                               std::vector<std::string>& warnings) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) return setting;
  const std::string was = setting.substr(0, equals);
  const std::string is = current_name(was, keys);
  if (is != was) warnings.push_back("command line: '" + was + "' is now called '" + is + "'");
  return is + setting.substr(equals);
}

}  // namespace flexneck::pipeline
