// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/study_node.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/units.h"

namespace flexneck::pipeline {

double fallback_number(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    throw std::logic_error("the table of keys has no number '" + std::string(text) + "'");
  return number;
}

std::string StudyTable::Node::dotted(const std::string& key) const {
  return path.empty() ? key : path + "." + key;
}

const Key& StudyTable::Node::row(const std::string& key) const {
  const Key* const found = find_key(keys, key);
  if (found == nullptr) throw std::logic_error("the table of keys has no row of " + dotted(key));
  return *found;
}

const Key& StudyTable::Node::row(const std::string& key, KeyType type) const {
  const Key& found = row(key);
  if (!serves_as(found.type, type))
    throw std::logic_error("the table of keys has another type for " + dotted(key));
  return found;
}

const toml::node* StudyTable::Node::find(const std::string& key) {
  if (std::find(known.begin(), known.end(), key) == known.end()) known.push_back(key);
  const toml::node* const inherited = below ? below->find(key) : nullptr;
  const toml::node* const own = table == nullptr ? nullptr : table->get(key);
  if (own == nullptr) return inherited;
  // In a table over another one an empty list removes the key.
  const bool is_emptied = inherited != nullptr && own->is_array() && own->as_array()->empty();
  return is_emptied ? nullptr : own;
}

const StudyTable::Node& StudyTable::Node::holder(const std::string& key) const {
  const bool is_here = table != nullptr && table->get(key) != nullptr;
  if (is_here || !below) return *this;
  const Node& deeper = below->holder(key);
  return deeper.table != nullptr && deeper.table->get(key) != nullptr ? deeper : *this;
}

void StudyTable::Node::refuse(const std::string& key, const std::string& problem) const {
  const Node& at = holder(key);
  const toml::node* node = at.table == nullptr ? nullptr : at.table->get(key);
  if (node == nullptr) node = at.table;
  const std::string where = node == nullptr ? std::string() : location_of(*node);
  throw InputError(where + at.dotted(key) + ": " + problem);
}

std::string StudyTable::Node::misspelt(const std::string& key) const {
  std::vector<std::string> others;
  if (table != nullptr)
    for (const auto& [name, ignored] : *table)
      if (std::find(known.begin(), known.end(), name.str()) == known.end())
        others.emplace_back(name.str());
  const std::string near = nearest_name(others, key);
  return near.empty() ? near : "; is '" + near + "' a misspelling of it?";
}

namespace {

/// Text such as "a, b or c".
std::string alternatives(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k)
    text += (k == 0 ? "" : k + 1 < names.size() ? ", " : " or ") + names[k];
  return text;
}

bool is_table_of_keys(const toml::node& node) {
  const toml::table* const table = node.as_table();
  return table != nullptr ? !table->contains("value") : node.is_array_of_tables();
}

}  // namespace

std::string StudyTable::Node::unknown(const std::string& key) const {
  constexpr std::size_t kMost = 4;
  const toml::node& node = *table->get(key);
  const Key* const row = find_key(keys, key);
  if (row != nullptr) {
    std::string where;
    for (const Key& other : keys) {
      const toml::node* const kind = table->get(other.name);
      if (other.details.choices == nullptr || other.fallback != kRequired || kind == nullptr)
        continue;
      where +=
          (where.empty() ? "with " : ", ") + std::string(other.name) + " = " + toml_text(*kind);
    }
    return "has no effect " + (where.empty() ? "here" : where) + " (" + std::string(row->what) +
           ")";
  }
  std::string text = "unknown key" + did_you_mean(known, key);
  const std::vector<std::string> places =
      tables_with_key(records->format, key, is_table_of_keys(node));
  if (!places.empty() && places.size() <= kMost)
    return text + "; it belongs in " + alternatives(places);
  std::vector<std::string> files;
  for (const Key& other : keys)
    if (other.type == KeyType::file)
      files.push_back("'" + std::string(other.name) + "' (" + std::string(other.what) + ")");
  const bool is_file =
      node.is_string() && std::filesystem::path(node.value_or(std::string())).has_extension();
  if (is_file && !files.empty() && files.size() <= kMost)
    text += "; is " + alternatives(files) + " meant?";
  return text;
}

namespace {

void add_new(std::vector<Parameter>& list, Parameter parameter) {
  const auto same = [&](const Parameter& other) { return other.key == parameter.key; };
  if (std::none_of(list.begin(), list.end(), same)) list.push_back(std::move(parameter));
}

/// Text of a value as the user would write it, without quotes and brackets.
std::string text_of(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto number = node.value_exact<double>()) return exact_text(*number);
  if (const toml::array* const list = node.as_array()) {
    std::string text;
    for (const toml::node& each : *list) text += (text.empty() ? "" : ", ") + text_of(each);
    return text;
  }
  return toml_text(node);
}

Origin origin_of(const toml::table& labels, const std::string& key) {
  const toml::node* const node = labels.get("origin");
  if (node == nullptr) return Origin::synthetic;
  const auto* const found =
      std::find(kOriginNames.begin(), kOriginNames.end(), node->value_or(std::string()));
  if (found == kOriginNames.end()) {
    throw InputError(location_of(*node) + key +
                     ": expected the origin published, inferred, calibrated or synthetic, found " +
                     text_of(*node));
  }
  return static_cast<Origin>(found - kOriginNames.begin());
}

}  // namespace

void StudyTable::Node::record(const std::string& key, const toml::node& value,
                              const toml::table* labels) {
  Parameter parameter{holder(key).dotted(key), text_of(value), Origin::synthetic, {}};
  if (labels != nullptr) {
    parameter.origin = origin_of(*labels, parameter.key);
    if (const toml::node* const note = labels->get("note")) {
      if (!note->is_string()) refuse(key, "expected a note as a text in quotes");
      parameter.note = note->value_or(std::string());
    }
  }
  add_new(records->parameters, std::move(parameter));
}

void StudyTable::Node::record_default(const std::string& key, const std::string& fallback) {
  find(key);
  // A key that is in none of the layers belongs to the lowest, which they share.
  const Node* lowest = this;
  while (lowest->below) lowest = lowest->below.get();
  add_new(records->defaults, {lowest->dotted(key), fallback, row(key).details.origin, {}});
}

bool StudyTable::Node::falls_back(const std::string& key, const Key& row, const std::string& unit) {
  if (row.fallback == kRequired || find(key) != nullptr) return false;
  // Only texts can be empty.
  const bool is_text = row.type == KeyType::text || row.type == KeyType::texts;
  if (row.fallback == kNone && !is_text) return false;
  const bool is_number =
      row.type == KeyType::count || row.type == KeyType::number || row.type == KeyType::quantity;
  record_default(
      key, (is_number ? exact_text(fallback_number(row.fallback)) : std::string(row.fallback)) +
               (unit.empty() ? "" : " " + unit));
  return true;
}

void StudyTable::Node::require_within(const std::string& key, const Range& range,
                                      double value) const {
  if (range.contains(value)) return;
  refuse(key, "expected " + range.text() + ", found " + exact_text(value));
}

const toml::node& StudyTable::Node::value(const std::string& key) {
  const toml::node* const node = find(key);
  if (node == nullptr) {
    const std::string near = misspelt(key);
    if (near.empty() && table != nullptr)
      for (const auto& [name, ignored] : *table)
        if (find_key(keys, name.str()) == nullptr)
          refuse(std::string(name.str()), unknown(std::string(name.str())));
    refuse(key, "expected this key, found none" +
                    (near.empty() ? " (" + std::string(row(key).what) + ")" : near));
  }
  const toml::table* const labels = node->as_table();
  if (labels == nullptr) {
    record(key, *node, nullptr);
    return *node;
  }
  const toml::node* const inner = labels->get("value");
  if (inner == nullptr) refuse(key, "expected a value or { value = …, origin = …, note = … }");
  const std::vector<std::string> allowed = {"value", "origin", "note"};
  for (const auto& [name, ignored] : *labels) {
    const std::string label(name.str());
    if (std::find(allowed.begin(), allowed.end(), label) == allowed.end()) {
      refuse(key, "unknown key '" + label + "'" + did_you_mean(allowed, label));
    }
  }
  record(key, *inner, labels);
  return *inner;
}

double StudyTable::Node::number_of(const toml::node& node, const std::string& key) const {
  if (!node.is_integer() && !node.is_floating_point()) {
    refuse(key, "expected a pure number without quotes or unit");
  }
  const double number = node.value_or(std::numeric_limits<double>::quiet_NaN());
  if (!std::isfinite(number)) refuse(key, "expected a finite number");
  return number;
}

double StudyTable::Node::quantity_of(const toml::node& node, const std::string& key,
                                     const std::string& si_unit) const {
  const auto text = node.value_exact<std::string>();
  if (!text) {
    refuse(key, "expected a number with its unit in quotes, such as \"1.5 " + si_unit + "\"");
  }
  try {
    return parse_quantity(*text, si_unit);
  } catch (const InputError& error) {
    refuse(key, error.what());
  }
}

const toml::array& StudyTable::Node::array(const std::string& key, std::size_t size) {
  if (size == 0) size = row(key).details.size;
  const toml::array* const found = value(key).as_array();
  if (found == nullptr || (size != 0 && found->size() != size)) {
    refuse(key, "expected a list" +
                    (size == 0 ? std::string() : " of " + std::to_string(size) + " entries"));
  }
  return *found;
}

}  // namespace flexneck::pipeline
