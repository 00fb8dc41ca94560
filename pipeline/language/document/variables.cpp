// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/variables.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/language/document/toml_limits.h"
#include "pipeline/language/document/toml_nodes.h"
#include "pipeline/language/document/toml_source.h"

namespace flexneck::pipeline {

namespace {

std::string text_of(const VariableValue& value) {
  return exact_text(value.number) + (value.unit.empty() ? "" : " " + value.unit);
}

/// Origin and note of a labelled value.
Label label_of(const toml::table& labels, const std::string& key) {
  Label label;
  if (const toml::node* const origin = labels.get("origin")) {
    const auto* const found =
        std::find(kOriginNames.begin(), kOriginNames.end(), origin->value_or(std::string()));
    if (found == kOriginNames.end())
      refuse_at(
          *origin, key,
          "expected the origin published, inferred, calibrated or synthetic, found another text");
    label.origin = static_cast<Origin>(found - kOriginNames.begin());
  }
  label.note = labels["note"].value_or(std::string());
  return label;
}

VariableValue number_or_quantity(const toml::node& node, const std::string& key) {
  const char* const expected = "expected a number, or a number with its unit in quotes";
  VariableValue value;
  if (const auto number = node.value_exact<std::int64_t>()) {
    value = {static_cast<double>(*number), true, {}, {}};
  } else if (const auto real = node.value_exact<double>()) {
    value = {*real, false, {}, {}};
  } else {
    refuse_at(node, key, expected);
  }
  if (!std::isfinite(value.number)) refuse_at(node, key, "expected a finite number");
  return value;
}

}  // namespace

std::optional<Label> weaker(std::optional<Label> a, std::optional<Label> b) {
  if (!a) return b;
  return b && b->origin > a->origin ? b : a;
}

Variables::Variables(toml::table&& table, std::string path)
    : table_(std::move(table)), path_(std::move(path)) {
  for (const auto& [key, node] : table_) {
    const std::string name(key.str());
    if (!is_variable_name(name))
      refuse_at(node, path_ + "." + name, "expected a name of letters, digits and '_'");
    if (name == "value" || name == "origin" || name == "note")
      refuse_at(node, path_ + "." + name,
                "expected a name other than value, origin and note, which are reserved");
    variables_[name] = {};
  }
  for (const auto& [name, ignored] : variables_) value_of(name);
}

const VariableValue& Variables::value_of(const std::string& name) {
  Variable& variable = variables_.at(name);
  if (variable.value) return *variable.value;
  const toml::node& node = *table_.get(name);
  const bool is_cycle = std::find(open_.begin(), open_.end(), name) != open_.end();
  open_.push_back(name);
  if (is_cycle) {
    std::string chain;
    for (const std::string& each : open_) chain += (chain.empty() ? "" : " -> ") + each;
    refuse_at(node, path_ + "." + name,
              "expected a value, found one that depends on itself: " + chain);
  }
  if (open_.size() > kMaxNested)
    refuse_at(node, path_ + "." + name,
              "expected at most " + std::to_string(kMaxNested) +
                  " variables that depend on one another, found more");
  variable.value = definition(name);
  open_.pop_back();
  return *variable.value;
}

VariableValue Variables::definition(const std::string& name) {
  const std::string key = path_ + "." + name;
  const toml::node& node = *table_.get(name);
  const toml::table* const labels = node.as_table();
  if (labels != nullptr && !is_labelled(*labels))
    refuse_at(node, key, "expected a value or { value = …, origin = …, note = … }");
  const toml::node& inner = labels == nullptr ? node : *labels->get("value");
  VariableValue value;
  const toml::value<std::string>* const text = inner.as_string();
  ProductText product;
  if (text != nullptr) {
    product = at_node(inner, key, [&] { return parse_product(text->get()); });
    value = product_value(product, inner, key);
  } else {
    value = number_or_quantity(inner, key);
  }
  if (labels != nullptr && (labels->contains("origin") || product.names.empty()))
    value.label = label_of(*labels, key);
  else if (product.names.empty() && !(value.unit.empty() && std::abs(value.number) == 1))
    value.label = Label();
  return value;
}

const VariableValue& Variables::named(const std::string& name, const toml::node& at,
                                      const std::string& key) {
  const auto found = variables_.find(name);
  if (found == variables_.end()) {
    std::vector<std::string> names;
    for (const auto& [each, ignored] : variables_) names.push_back(each);
    refuse_at(at, key,
              "expected a variable of [" + path_ + "], found '$" + name + "'" +
                  did_you_mean(names, name));
  }
  found->second.is_used = true;
  return value_of(name);
}

VariableValue Variables::product_value(const ProductText& product, const toml::node& at,
                                       const std::string& key) {
  VariableValue value{product.number, product.is_whole, product.unit, {}};
  // A product with a unit contains a datum, which has no origin.
  if (!product.unit.empty()) value.label = Label();
  for (const std::string& name : product.names) {
    const VariableValue& factor = named(name, at, key);
    value.number *= factor.number;
    value.is_whole = value.is_whole && factor.is_whole;
    if (!value.unit.empty() && !factor.unit.empty())
      refuse_at(at, key,
                "expected one unit at most, found '" + value.unit + "' and '" + factor.unit + "'");
    value.unit += factor.unit;
    value.label = weaker(value.label, factor.label);
  }
  if (!std::isfinite(value.number)) refuse_at(at, key, "expected a finite product");
  return value;
}

void Variables::finish() const {
  for (const auto& [name, variable] : variables_)
    if (!variable.is_used)
      refuse_at(*table_.get(name), path_ + "." + name,
                "expected a value that uses \"$" + name + "\", found none; remove the variable");
}

std::vector<Parameter> Variables::parameters() const {
  std::vector<Parameter> result;
  for (const auto& [name, variable] : variables_) {
    const Label label = variable.value->label.value_or(Label());
    result.push_back({path_ + "." + name, text_of(*variable.value), label.origin, label.note});
  }
  return result;
}

}  // namespace flexneck::pipeline
