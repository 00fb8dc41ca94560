// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/foundation/origin.h"

namespace flexneck::pipeline {

enum class KeyType {
  text,
  file,  ///< a path, relative to the folder of the file that has the key
  flag,
  count,  ///< a whole number
  number,
  quantity,  ///< a number with its unit
  texts,
  numbers,
  quantities,
  one_or_numbers,            ///< a number, or a list
  number_or_quantity,        ///< a pure number, or one with its unit
  expression_or_quantities,  ///< a text, or a list
  table,
  tables,
};

/// Range of the allowed numbers.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool has_low = true;  ///< true if `low` itself is allowed

  bool contains(double value) const;
  /// Text such as "a positive value", "a value of at least 1", "a value from 0 to 1"; empty for
  /// any.
  std::string text() const;
};
inline constexpr Range kPositive = {.low = 0, .has_low = false};
constexpr Range at_least(double low) { return {.low = low}; }

/// Results of a study that depend on a value.
enum class UsedBy {
  table,  ///< the results that depend on the key's table
  mesh,   ///< the mesh, and so all results
  modes,  ///< the modes, and so all experiments
  all_experiments,
  named_experiments,  ///< the experiments that name the table, as a case names its pulse
};

struct KeyDetails {
  Range range = {};
  std::size_t size = 0;                             ///< length of a list; 0: any
  std::vector<std::string> (*choices)() = nullptr;  ///< the allowed texts; none: all
  Origin origin = Origin::synthetic;                ///< origin of the fallback
  UsedBy used_by = UsedBy::table;
  bool changes_results = true;  ///< false if it concerns the computation or additional data only
};

/// Fallback of a key that is mandatory, and of a key without default: for the latter a reader asks
/// has() first, and texts are empty.
inline constexpr std::string_view kRequired;
inline constexpr std::string_view kNone = "-";

/// A key that files of a format may have, and its only definition: readers take type, unit,
/// fallback and range from here, and the reference of all keys is generated from it.
struct Key {
  std::string_view name = {};  ///< "*" stands for any name, chosen by the file
  KeyType type = KeyType::text;
  /// SI unit of a quantity; " | " separates the units of kinds with different dimensions.
  std::string_view unit = {};
  /// Value of an absent key, written as in a file but without the SI unit; kRequired or kNone.
  std::string_view fallback = {};
  std::string_view what = {};  ///< description for the reference, without a full stop
  KeyDetails details = {};
  std::span<const Key> keys = {};  ///< keys of a table

  using Text = std::string_view;

  static constexpr Key text(Text name, Text fallback, Text what, KeyDetails details = {}) {
    return {name, KeyType::text, {}, fallback, what, details, {}};
  }
  static constexpr Key file(Text name, Text fallback, Text what) {
    return {name, KeyType::file, {}, fallback, what, {}, {}};
  }
  static constexpr Key flag(Text name, Text fallback, Text what, KeyDetails details = {}) {
    return {name, KeyType::flag, {}, fallback, what, details, {}};
  }
  static constexpr Key count(Text name, Text fallback, Text what, KeyDetails details = {}) {
    return {name, KeyType::count, {}, fallback, what, details, {}};
  }
  static constexpr Key number(Text name, Text fallback, Text what, KeyDetails details = {}) {
    return {name, KeyType::number, {}, fallback, what, details, {}};
  }
  static constexpr Key quantity(Text name, Text unit, Text fallback, Text what,
                                KeyDetails details = {}) {
    return {name, KeyType::quantity, unit, fallback, what, details, {}};
  }
  static constexpr Key texts(Text name, Text fallback, Text what, KeyDetails details = {}) {
    return {name, KeyType::texts, {}, fallback, what, details, {}};
  }
  static constexpr Key numbers(Text name, Text fallback, Text what, KeyDetails details = {}) {
    return {name, KeyType::numbers, {}, fallback, what, details, {}};
  }
  static constexpr Key quantities(Text name, Text unit, Text fallback, Text what,
                                  KeyDetails details = {}) {
    return {name, KeyType::quantities, unit, fallback, what, details, {}};
  }
  static constexpr Key one_or_numbers(Text name, Text fallback, Text what,
                                      KeyDetails details = {}) {
    return {name, KeyType::one_or_numbers, {}, fallback, what, details, {}};
  }
  static constexpr Key number_or_quantity(Text name, Text unit, Text fallback, Text what) {
    return {name, KeyType::number_or_quantity, unit, fallback, what, {}, {}};
  }
  static constexpr Key expression_or_quantities(Text name, Text unit, Text fallback, Text what) {
    return {name, KeyType::expression_or_quantities, unit, fallback, what, {}, {}};
  }
  static constexpr Key table(Text name, Text what, std::span<const Key> keys,
                             UsedBy used_by = UsedBy::table) {
    return {name, KeyType::table, {}, kNone, what, {.used_by = used_by}, keys};
  }
  static constexpr Key tables(Text name, Text what, std::span<const Key> keys,
                              UsedBy used_by = UsedBy::table) {
    return {name, KeyType::tables, {}, kNone, what, {.used_by = used_by}, keys};
  }
};

/// Returns whether a key of one type may be read as another: a key of type one_or_numbers serves as
/// a number and as a list of numbers.
bool serves_as(KeyType type, KeyType asked);

/// Description of a key's type: "text", "quantity", "list of 3 quantities", …
std::string type_text(const Key& key);

/// Row of a key; null if there is none.
const Key* find_key(std::span<const Key> keys, std::string_view name);

/// A key at any depth found by its dotted name, which includes names of tables:
/// "case.flexion-60.arm".
struct DottedKey {
  const Key* key = nullptr;  ///< null if there is none
  UsedBy used_by = UsedBy::table;
};
DottedKey find_dotted_key(std::span<const Key> keys, std::string_view dotted);

/// Tables of a format that have a key, as "[modes]" or "[[case]]", each by its shortest names.
/// @param is_table  whether the key itself is a table
std::vector<std::string> tables_with_key(std::span<const Key> format, std::string_view name,
                                         bool is_table);

/// Keys of one table followed by keys that several tables share.
template <std::size_t N, std::size_t M>
constexpr std::array<Key, N + M> joined(const std::array<Key, N>& own,
                                        const std::array<Key, M>& shared) {
  std::array<Key, N + M> all{};
  for (std::size_t k = 0; k < N; ++k) all[k] = own[k];
  for (std::size_t k = 0; k < M; ++k) all[N + k] = shared[k];
  return all;
}

}  // namespace flexneck::pipeline
