// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/key_reference.h"

#include <algorithm>

#include <fmt/core.h>

#include "pipeline/process/wrapped_text.h"

namespace flexneck::pipeline {

namespace {

bool is_table(const Key& key) { return key.type == KeyType::table || key.type == KeyType::tables; }

std::string heading(const std::string& path, const Key& table) {
  return table.type == KeyType::tables ? "[[" + path + "]]" : "[" + path + "]";
}

std::string shown_name(const Key& key) {
  return key.name == "*" ? "<name>" : std::string(key.name);
}

/// Type, unit, default and allowed values of a key, as text.
std::string kind_text(const Key& key) {
  std::string text = type_text(key);
  if (!key.unit.empty()) text += " in " + std::string(key.unit);
  if (key.details.choices != nullptr) {
    std::string names;
    for (const std::string& name : key.details.choices())
      names += (names.empty() ? "" : " | ") + name;
    text += ": " + names;
  }
  if (const std::string range = key.details.range.text(); !range.empty()) text += ", " + range;
  if (key.fallback == kRequired) return text + "; required";
  if (key.fallback == kNone) return text;
  return text + "; default " + std::string(key.fallback);
}

}  // namespace

std::string tables_text(std::span<const Key> keys) {
  std::size_t width = 0;
  const auto label = [](const Key& key) {
    return is_table(key) ? heading(std::string(key.name), key) : std::string(key.name);
  };
  for (const Key& key : keys) width = std::max(width, label(key).size() + 2);
  std::string text;
  for (const Key& key : keys) {
    const std::string what = wrapped(std::string(key.what), std::string(width, ' '));
    text += fmt::format("{:<{}}", label(key), width) + what.substr(width);
  }
  return text;
}

std::string key_text(const Key& key) {
  return wrapped(fmt::format("{} ({})", shown_name(key), kind_text(key)), "  ") +
         wrapped(std::string(key.what), "      ");
}

std::string table_text(const std::string& path, const Key& table) {
  std::string text = wrapped(heading(path, table) + " " + std::string(table.what), "");
  std::string below;
  for (const Key& key : table.keys) {
    if (is_table(key)) {
      below += "\n" + table_text(path + "." + shown_name(key), key);
    } else {
      text += key_text(key);
    }
  }
  return text + below;
}

}  // namespace flexneck::pipeline
