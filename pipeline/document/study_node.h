// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/foundation/provenance.h"
#include "pipeline/document/study_document.h"
#include "pipeline/document/toml_source.h"

namespace flexneck::pipeline {

/// What the tables of a document have been asked for.
struct StudyRecords {
  std::span<const Key> format;        ///< of the whole document
  std::vector<Parameter> parameters;  ///< read
  std::vector<Parameter> defaults;    ///< asked for, but not there
};

/// The number that a row of the table of keys has as its fallback, in SI units.
double fallback_number(std::string_view text);

/// A table as it stands in the file: finds values, in the tables below it too, and records them.
struct StudyTable::Node {
  const toml::table* table = nullptr;  ///< kept alive by the owner of `records`; null if absent
  std::shared_ptr<StudyRecords> records;
  std::string path;
  std::span<const Key> keys;  ///< what there may be
  std::vector<std::string> known;
  std::shared_ptr<Node> below;  ///< asked for keys that are not here; may be null

  std::string dotted(const std::string& key) const;
  /// What a key is. @throws std::logic_error if there is no such row or it is of another type.
  const Key& row(const std::string& key) const;
  const Key& row(const std::string& key, KeyType type) const;
  /// The node of a key, labels and all; null if there is none.
  const toml::node* find(const std::string& key);
  /// The node that a key is found in; this one if it is nowhere.
  const Node& holder(const std::string& key) const;
  [[noreturn]] void refuse(const std::string& key, const std::string& problem) const;

  /// The value of a key, out of its { value, origin, note } where it has one; notes the parameter.
  const toml::node& value(const std::string& key);
  /// @param fallback  of the key's row, or one that depends on other keys
  void record_default(const std::string& key, const std::string& fallback);
  /// True for a key that is not there and has a fallback, which is recorded.
  bool falls_back(const std::string& key, const Key& row, const std::string& unit = {});

  double number_of(const toml::node& node, const std::string& key) const;
  double quantity_of(const toml::node& node, const std::string& key,
                     const std::string& si_unit) const;
  void require_within(const std::string& key, const Range& range, double value) const;
  /// @param size  0 means that of the row
  const toml::array& array(const std::string& key, std::size_t size);

  template <typename T>
  T scalar(const std::string& key, const char* expected) {
    const auto found = value(key).value_exact<T>();
    if (!found) refuse(key, std::string("expected ") + expected);
    return *found;
  }

  /// "; is 'x' meant to be it?" of a key that is there and that nobody has asked for.
  std::string misspelt(const std::string& key) const;
  /// What is wrong with a key that is there and that nobody has asked for.
  std::string unknown(const std::string& key) const;
  void record(const std::string& key, const toml::node& value, const toml::table* labels);
};

}  // namespace flexneck::pipeline
