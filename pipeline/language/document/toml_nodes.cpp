// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/toml_nodes.h"

#include <algorithm>
#include <utility>

#include "pipeline/language/document/toml_source.h"

namespace flexneck::pipeline {

void refuse_at(const toml::node& node, const std::string& key, const std::string& problem) {
  throw InputError(location_of(node) + key + ": " + problem);
}

bool is_labelled(const toml::table& table) {
  return table.contains("value") && std::all_of(table.begin(), table.end(), [](const auto& each) {
           const std::string_view key = each.first.str();
           return key == "value" || key == "origin" || key == "note";
         });
}

toml::value<std::string>* text_node(toml::table& table, const std::string& key) {
  toml::node* node = table.get(key);
  if (node != nullptr && node->is_table() && is_labelled(*node->as_table()))
    node = node->as_table()->get("value");
  return node == nullptr ? nullptr : node->as_string();
}

std::string dotted(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string element_path(const std::string& path, const toml::table& element, std::size_t index) {
  return path + "." + element["name"].value_or(std::to_string(index + 1));
}

std::vector<std::string> keys_of(const toml::table& table) {
  std::vector<std::string> keys;
  for (const auto& [key, ignored] : table) keys.emplace_back(key.str());
  return keys;
}

void set_source(toml::node& node, const toml::source_region& source) {
  // The library sets the source in its parser only; the node itself is not const.
  const_cast<toml::source_region&>(node.source()) = source;
}

toml::table taken_table(toml::table& tree, const std::string& key, const std::string& path) {
  toml::node* const node = tree.get(key);
  if (node == nullptr) return {};
  if (!node->is_table()) refuse_at(*node, path, "expected a table [" + path + "]");
  toml::table table = std::move(*node->as_table());
  tree.erase(key);
  return table;
}

}  // namespace flexneck::pipeline
