// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/key.h"

#include <algorithm>

#include <fmt/core.h>

namespace flexneck::pipeline {

bool Range::contains(double value) const {
  return (has_low ? value >= low : value > low) && value <= high;
}

std::string Range::text() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (low == -kInfinity) return high == kInfinity ? "" : fmt::format("a value of at most {}", high);
  if (high != kInfinity)
    return fmt::format("a value {} {} to {}", has_low ? "from" : "above", low, high);
  if (!has_low) return low == 0 ? "a positive value" : fmt::format("a value above {}", low);
  return low == 0 ? "no negative value" : fmt::format("a value of at least {}", low);
}

bool serves_as(KeyType type, KeyType asked) {
  switch (type) {
    case KeyType::one_or_numbers:
      return asked == KeyType::number || asked == KeyType::numbers;
    case KeyType::number_or_quantity:
      return asked == KeyType::number || asked == KeyType::quantity;
    case KeyType::expression_or_quantities:
      return asked == KeyType::text || asked == KeyType::quantities;
    default:
      return type == asked;
  }
}

std::string type_text(const Key& key) {
  const auto list_of = [&](const std::string& what) {
    return key.details.size == 0 ? "list of " + what
                                 : fmt::format("list of {} {}", key.details.size, what);
  };
  switch (key.type) {
    case KeyType::text:
      return "text";
    case KeyType::file:
      return "file";
    case KeyType::flag:
      return "true or false";
    case KeyType::count:
      return "whole number";
    case KeyType::number:
      return "number";
    case KeyType::quantity:
      return "quantity";
    case KeyType::texts:
      return list_of("texts");
    case KeyType::numbers:
      return list_of("numbers");
    case KeyType::quantities:
      return list_of("quantities");
    case KeyType::one_or_numbers:
      return "number or list of numbers";
    case KeyType::number_or_quantity:
      return "number or quantity";
    case KeyType::expression_or_quantities:
      return "expression or list of quantities";
    case KeyType::table:
      return "table";
    case KeyType::tables:
      return "tables";
  }
  return {};
}

const Key* find_key(std::span<const Key> keys, std::string_view name) {
  const auto named = [&](std::string_view wanted) {
    return std::find_if(keys.begin(), keys.end(),
                        [&](const Key& key) { return key.name == wanted; });
  };
  auto found = named(name);
  if (found == keys.end()) found = named("*");
  return found == keys.end() ? nullptr : &*found;
}

namespace {

/// Finds a key below a table. Names of elements and user-named tables may contain dots.
DottedKey find_below(const Key& table, std::string_view rest) {
  const std::span<const Key> keys = table.keys;
  if (table.type == KeyType::table) return find_dotted_key(keys, rest);
  for (std::size_t dot = rest.find('.'); dot != std::string_view::npos;
       dot = rest.find('.', dot + 1)) {
    const DottedKey found = find_dotted_key(keys, rest.substr(dot + 1));
    if (found.key != nullptr) return found;
  }
  return {};
}

}  // namespace

DottedKey find_dotted_key(std::span<const Key> keys, std::string_view dotted) {
  DottedKey found;
  for (std::size_t dot = dotted.find('.'); found.key == nullptr; dot = dotted.find('.', dot + 1)) {
    const Key* const key = find_key(keys, dotted.substr(0, dot));
    const bool is_table =
        key != nullptr && (key->type == KeyType::table || key->type == KeyType::tables);
    if (dot == std::string_view::npos) {
      if (key != nullptr) found = {key, key->details.used_by};
      break;
    }
    if (!is_table) continue;
    found = find_below(*key, dotted.substr(dot + 1));
    if (found.used_by == UsedBy::table) found.used_by = key->details.used_by;
  }
  return found;
}

std::vector<std::string> tables_with_key(std::span<const Key> format, std::string_view name,
                                         bool is_table) {
  struct Table {
    std::string path, heading;
    std::span<const Key> keys;
    std::size_t depth;
  };
  std::vector<Table> tables = {{"", "the top level", format, 0}};
  std::vector<std::string> found;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const Table table = tables[k];
    for (const Key& key : table.keys) {
      if (key.name == name && key.keys.empty() != is_table) found.push_back(table.heading);
      const bool is_known = std::ranges::any_of(tables, [&](const Table& other) {
        return other.keys.data() == key.keys.data() && other.depth <= table.depth;
      });
      if (key.keys.empty() || is_known) continue;
      const std::string path = table.path + (key.name == "*" ? "<name>" : std::string(key.name));
      tables.push_back({path + ".",
                        key.type == KeyType::tables ? "[[" + path + "]]" : "[" + path + "]",
                        key.keys, table.depth + 1});
    }
  }
  return found;
}

}  // namespace flexneck::pipeline
