// SPDX-License-Identifier: GPL-3.0-or-later
// Replaces products of variables by their values.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "geometry/foundation/output_file.h"
#include "pipeline/language/document/toml_nodes.h"
#include "pipeline/language/document/variables.h"

namespace flexneck::pipeline {

namespace {

constexpr double kMaxWhole = 9007199254740992;  ///< range of exact integers

bool is_product(const toml::node& node) {
  const toml::value<std::string>* const text = node.as_string();
  return text != nullptr && names_variables(text->get());
}

bool has_products(const toml::array& list) {
  return std::any_of(list.begin(), list.end(), [](const toml::node& each) {
    const toml::array* const inner = each.as_array();
    return is_product(each) || (inner != nullptr && has_products(*inner));
  });
}

/// Label of an element that names no variable: synthetic, or none for zero.
std::optional<Label> label_of_plain(const toml::node& element) {
  double number = element.value_or(1.0);
  if (const toml::value<std::string>* const text = element.as_string())
    std::from_chars(text->get().data(), text->get().data() + text->get().size(), number);
  return number == 0 ? std::optional<Label>() : Label();
}

/// Calls use() with a node for a value, at the source position of another node.
template <class Use>
void with_node(const VariableValue& value, const toml::source_region& source, const Use& use) {
  const auto place = [&](auto&& node) {
    set_source(node, source);
    use(std::forward<decltype(node)>(node));
  };
  if (!value.unit.empty())
    place(toml::value<std::string>(exact_text(value.number) + " " + value.unit));
  else if (value.is_whole && std::abs(value.number) < kMaxWhole)
    place(toml::value<std::int64_t>(static_cast<std::int64_t>(value.number)));
  else
    place(toml::value<double>(value.number));
}

void insert_label(toml::table& labels, const Label& label) {
  labels.insert_or_assign("origin", name_of(label.origin));
  if (!label.note.empty() && !labels.contains("note")) labels.insert("note", label.note);
}

/// Adds an origin to a plain value. Without one it counts as synthetic anyway.
void wrap(toml::table& table, const std::string& key, const Label& label) {
  if (label.origin == Origin::synthetic && label.note.empty()) return;
  toml::node& value = *table.get(key);
  toml::table labels;
  set_source(labels, value.source());
  value.visit([&](auto& each) { labels.insert("value", std::move(each)); });
  insert_label(labels, label);
  table.insert_or_assign(key, std::move(labels));
}

}  // namespace

void Variables::substitute(toml::table& tree) { substitute_in(tree, {}); }

void Variables::substitute_in(toml::table& table, const std::string& path) {
  for (const std::string& key : keys_of(table)) substitute_key(table, key, dotted(path, key));
}

void Variables::substitute_key(toml::table& table, const std::string& key,
                               const std::string& path) {
  toml::node& node = *table.get(key);
  toml::table* const inner = node.as_table();
  if (inner != nullptr && is_labelled(*inner)) {
    const Replacement made = replace(*inner, "value", path);
    if (made.is_replaced && made.label && !inner->contains("origin"))
      insert_label(*inner, *made.label);
  } else if (inner != nullptr) {
    substitute_in(*inner, path);
  } else {
    if (toml::array* const list = node.as_array()) substitute_tables(*list, path);
    const Replacement made = replace(table, key, path);
    if (made.is_replaced && made.label) wrap(table, key, *made.label);
  }
}

void Variables::substitute_tables(toml::array& list, const std::string& path) {
  for (std::size_t k = 0; k < list.size(); ++k) {
    if (toml::table* const element = list[k].as_table())
      substitute_in(*element, element_path(path, *element, k));
    if (toml::array* const inner = list[k].as_array()) substitute_tables(*inner, path);
  }
}

Variables::Replacement Variables::replace(toml::table& table, const std::string& key,
                                          const std::string& path) {
  toml::node& node = *table.get(key);
  if (toml::array* const list = node.as_array())
    return has_products(*list) ? replace_elements(*list, path) : Replacement();
  if (!is_product(node)) return {};
  const ProductText product =
      at_node(node, path, [&] { return parse_product(node.as_string()->get()); });
  const VariableValue value = product_value(product, node, path);
  const toml::source_region source = node.source();
  with_node(value, source,
            [&](auto&& made) { table.insert_or_assign(key, std::forward<decltype(made)>(made)); });
  return {true, value.label};
}

Variables::Replacement Variables::replace_elements(toml::array& list, const std::string& path) {
  Replacement result{true, {}};
  toml::array made;
  set_source(made, list.source());
  const auto add = [&](auto&& node) { made.push_back(std::forward<decltype(node)>(node)); };
  for (toml::node& each : list) {
    if (is_product(each)) {
      const ProductText product =
          at_node(each, path, [&] { return parse_product(each.as_string()->get()); });
      const VariableValue value = product_value(product, each, path);
      result.label = weaker(std::move(result.label), value.label);
      with_node(value, each.source(), add);
      continue;
    }
    if (toml::array* const inner = each.as_array()) {
      result.label = weaker(std::move(result.label), replace_elements(*inner, path).label);
    } else {
      result.label = weaker(std::move(result.label), label_of_plain(each));
    }
    each.visit([&](auto& node) { add(std::move(node)); });
  }
  list = std::move(made);
  return result;
}

}  // namespace flexneck::pipeline
