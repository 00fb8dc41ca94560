// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <toml++/toml.h>

#include "geometry/foundation/error.h"

namespace flexneck::pipeline {

/// @throws InputError "<file>:<line>:<column>: <key>: <problem>"
[[noreturn]] void refuse_at(const toml::node& node, const std::string& key,
                            const std::string& problem);

/// Calls make() and prefixes location and key to its input errors.
template <class Make>
auto at_node(const toml::node& node, const std::string& key, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    refuse_at(node, key, error.what());
  }
}

/// True for { value = … } with or without an origin and a note.
bool is_labelled(const toml::table& table);

/// Text of a key, unwrapped from { value = … } if labelled; null if it is not a text.
toml::value<std::string>* text_node(toml::table& table, const std::string& key);

/// Joins "path.key", or returns the key alone if the path is empty.
std::string dotted(const std::string& path, const std::string& key);
/// Path of an element of an array of tables: by its name, or by its number from 1.
std::string element_path(const std::string& path, const toml::table& element, std::size_t index);

std::vector<std::string> keys_of(const toml::table& table);

/// Gives a new node the file, line and column of the one that it replaces.
void set_source(toml::node& node, const toml::source_region& source);

/// Removes and returns the table that a key holds; empty if there is none.
/// @throws InputError if the key holds something else.
toml::table taken_table(toml::table& tree, const std::string& key, const std::string& path);

}  // namespace flexneck::pipeline
