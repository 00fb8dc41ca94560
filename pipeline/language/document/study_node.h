// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/foundation/provenance.h"
#include "pipeline/language/document/study_document.h"
#include "pipeline/language/document/toml_source.h"

namespace flexneck::pipeline {

/// Record of the values read from the tables of a document.
struct StudyRecords {
  std::span<const Key> format;        ///< keys of the whole document
  std::vector<Parameter> parameters;  ///< values read
  std::vector<Parameter> defaults;    ///< fallbacks of absent keys
};

/// The number that a row of the table of keys has as its fallback, in SI units.
double fallback_number(std::string_view text);

/// A table of the file: finds values, also in the tables below it, and records them.
struct StudyTable::Node {
  const toml::table* table = nullptr;  ///< kept alive by the owner of `records`; null if absent
  std::shared_ptr<StudyRecords> records;
  std::string path;
  std::span<const Key> keys;  ///< the keys allowed in the table
  std::vector<std::string> known;
  std::shared_ptr<Node> below;  ///< table asked for keys that this one lacks; may be null

  std::string dotted(const std::string& key) const;
  /// Row of a key. @throws std::logic_error if there is no such row or it is of another type.
  const Key& row(const std::string& key) const;
  const Key& row(const std::string& key, KeyType type) const;
  /// Node of a key, labels included; null if there is none.
  const toml::node* find(const std::string& key);
  /// The layer that holds a key; this one if none does.
  const Node& holder(const std::string& key) const;
  [[noreturn]] void refuse(const std::string& key, const std::string& problem) const;

  /// The value of a key, unwrapped from { value, origin, note } if labelled; records the parameter.
  const toml::node& value(const std::string& key);
  /// @param fallback  fallback in the key's row, or one that depends on other keys
  void record_default(const std::string& key, const std::string& fallback);
  /// True for an absent key that has a fallback, which is recorded.
  bool falls_back(const std::string& key, const Key& row, const std::string& unit = {});

  double number_of(const toml::node& node, const std::string& key) const;
  double quantity_of(const toml::node& node, const std::string& key,
                     const std::string& si_unit) const;
  void require_within(const std::string& key, const Range& range, double value) const;
  /// @param size  0 means the size in the row
  const toml::array& array(const std::string& key, std::size_t size);

  template <typename T>
  T scalar(const std::string& key, const char* expected) {
    const auto found = value(key).value_exact<T>();
    if (!found) refuse(key, std::string("expected ") + expected);
    return *found;
  }

  /// Suggestion "; is 'x' meant to be it?" if a key that nobody asked for resembles this one.
  std::string misspelt(const std::string& key) const;
  /// Error text for a present key that nobody has asked for.
  std::string unknown(const std::string& key) const;
  void record(const std::string& key, const toml::node& value, const toml::table* labels);
};

}  // namespace flexneck::pipeline
