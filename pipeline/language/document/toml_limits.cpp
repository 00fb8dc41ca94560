// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/toml_limits.h"

#include <algorithm>
#include <string_view>

#include "geometry/foundation/error.h"
#include "geometry/foundation/printable.h"
#include "pipeline/language/document/toml_source.h"

namespace flexneck::pipeline {

namespace {

/// Index behind the three quotes that end a text. Up to two more quotes before them belong to it.
std::size_t behind_long(std::string_view text, std::size_t quotes) {
  std::size_t end = quotes + 3;
  while (end < quotes + 5 && end < text.size() && text[end] == text[quotes]) ++end;
  return end;
}

/// Index behind the quoted text that begins at an index; the end of the input if it is
/// unterminated.
std::size_t end_of_quoted(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string triple(3, quote);
  const bool is_long = text.substr(begin).starts_with(triple);
  const std::string_view closing = is_long ? std::string_view(triple) : text.substr(begin, 1);
  for (std::size_t place = begin + closing.size(); place < text.size(); ++place) {
    if (quote == '"' && text[place] == '\\')
      ++place;
    else if (text.substr(place).starts_with(closing))
      return is_long ? behind_long(text, place) : place + 1;
    else if (!is_long && text[place] == '\n')
      return place;
  }
  return text.size();
}

void check_node(const std::string& key, const toml::node& node) {
  const auto refuse = [&](const std::string& text) {
    throw InputError(location_of(node) + printable(key) +
                     ": expected a text without control characters, found \"" + printable(text) +
                     "\"");
  };
  if (find_unprintable(key) != std::string::npos) refuse(key);
  if (const toml::value<std::string>* const text = node.as_string())
    if (find_unprintable(text->get()) != std::string::npos) refuse(text->get());
  if (const toml::table* const table = node.as_table()) check_texts(*table);
  if (const toml::array* const list = node.as_array())
    for (const toml::node& each : *list) check_node(key, each);
}

}  // namespace

void check_nesting(const std::string& text, const std::string& place) {
  std::size_t brackets = 0;
  std::size_t dots = 0;  // count since the last character that a key cannot contain
  for (std::size_t k = 0; k < text.size(); ++k) {
    const char c = text[k];
    if (c == '"' || c == '\'') {
      k = end_of_quoted(text, k) - 1;
      continue;
    }
    if (c == '#') k = std::min(text.find('\n', k), text.size());
    if (c == '.') ++dots;
    if (c == '[' || c == '{') ++brackets;
    if ((c == ']' || c == '}') && brackets > 0) --brackets;
    if (std::string_view("[]{}=,\n#").find(c) != std::string_view::npos) dots = 0;
    if (std::max(brackets, dots) <= kMaxNested) continue;
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(k), '\n');
    throw InputError(place + ":" + std::to_string(line) + ": expected at most " +
                     std::to_string(kMaxNested) +
                     " nested brackets or parts of a dotted key, found more");
  }
}

void check_texts(const toml::table& table) {
  for (const auto& [key, node] : table) check_node(std::string(key.str()), node);
}

}  // namespace flexneck::pipeline
