// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/study/study_document.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "geometry/foundation/units.h"
#include "pipeline/study/toml_source.h"

namespace flexneck::pipeline {

namespace {

struct Records {
  std::vector<Parameter> parameters;  ///< read
  std::vector<Parameter> defaults;    ///< asked for, but not there
};

}  // namespace

struct StudyDocument::Impl {
  toml::table root;
  std::vector<InputFile> files;
  Records records;
};

struct StudyTable::Node {
  const toml::table* table = nullptr;  // kept alive by `records`' owner; null if absent
  std::shared_ptr<Records> records;
  std::string path;
  std::vector<std::string> known;
  std::shared_ptr<Node> below;  // asked for keys that are not here; may be null

  std::string dotted(const std::string& key) const { return path.empty() ? key : path + "." + key; }

  const toml::node* find(const std::string& key) {
    if (std::find(known.begin(), known.end(), key) == known.end()) known.push_back(key);
    const toml::node* const inherited = below ? below->find(key) : nullptr;
    const toml::node* const own = table == nullptr ? nullptr : table->get(key);
    return own != nullptr ? own : inherited;
  }

  /// The node that a key is found in; this one if it is nowhere.
  const Node& holder(const std::string& key) const {
    const bool is_here = table != nullptr && table->get(key) != nullptr;
    if (is_here || !below) return *this;
    const Node& deeper = below->holder(key);
    return deeper.table != nullptr && deeper.table->get(key) != nullptr ? deeper : *this;
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& problem) const {
    const Node& at = holder(key);
    const toml::node* node = at.table == nullptr ? nullptr : at.table->get(key);
    if (node == nullptr) node = at.table;
    const std::string where = node == nullptr ? std::string() : location_of(*node);
    throw InputError(where + at.dotted(key) + ": " + problem);
  }

  /// A key that is there, that nobody has asked for and that may be meant to be this one.
  std::string misspelt(const std::string& key) const {
    std::vector<std::string> others;
    if (table != nullptr)
      for (const auto& [name, ignored] : *table)
        if (std::find(known.begin(), known.end(), name.str()) == known.end())
          others.emplace_back(name.str());
    const std::string near = nearest_name(others, key);
    return near.empty() ? near : "; is '" + near + "' meant to be it?";
  }

  /// The value of a key, out of its { value, origin, note } where it has one; notes the parameter.
  const toml::node& value(const std::string& key);
  void record(const std::string& key, const toml::node& value, const toml::table* labels);
  void record_default(const std::string& key, const std::string& value);

  template <typename T>
  T scalar(const std::string& key, const char* expected) {
    const auto found = value(key).value_exact<T>();
    if (!found) refuse(key, std::string("expected ") + expected);
    return *found;
  }

  double number_of(const toml::node& node, const std::string& key) const {
    if (!node.is_integer() && !node.is_floating_point()) {
      refuse(key, "expected a pure number without quotes or unit");
    }
    const double number = node.value_or(std::numeric_limits<double>::quiet_NaN());
    if (!std::isfinite(number)) refuse(key, "expected a finite number");
    return number;
  }

  double quantity_of(const toml::node& node, const std::string& key,
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

  const toml::array& array(const std::string& key, std::size_t size) {
    const toml::array* const found = value(key).as_array();
    if (found == nullptr || (size != 0 && found->size() != size)) {
      refuse(key, "expected a list" +
                      (size == 0 ? std::string() : " of " + std::to_string(size) + " entries"));
    }
    return *found;
  }
};

namespace {

void add_new(std::vector<Parameter>& list, Parameter parameter) {
  const auto same = [&](const Parameter& other) { return other.key == parameter.key; };
  if (std::none_of(list.begin(), list.end(), same)) list.push_back(std::move(parameter));
}

/// As the user would write it, without quotes and brackets.
std::string text_of(const toml::node& node) {
  if (const auto text = node.value_exact<std::string>()) return *text;
  if (const auto number = node.value_exact<double>()) return exact_text(*number);
  if (const toml::array* const list = node.as_array()) {
    std::string text;
    for (const toml::node& each : *list) text += (text.empty() ? "" : ", ") + text_of(each);
    return text;
  }
  std::ostringstream stream;
  node.visit([&](const auto& value) { stream << value; });
  return stream.str();
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
    parameter.note = (*labels)["note"].value_or(std::string());
  }
  add_new(records->parameters, std::move(parameter));
}

void StudyTable::Node::record_default(const std::string& key, const std::string& value) {
  find(key);
  // A key that is in none of the layers belongs to the lowest, which they share.
  const Node* lowest = this;
  while (lowest->below) lowest = lowest->below.get();
  add_new(records->defaults, {lowest->dotted(key), value, Origin::synthetic, {}});
}

const toml::node& StudyTable::Node::value(const std::string& key) {
  const toml::node* const node = find(key);
  if (node == nullptr) refuse(key, "expected this key, found none" + misspelt(key));
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

StudyTable::StudyTable(std::shared_ptr<Node> node) : node_(std::move(node)) {}

bool StudyTable::has(const std::string& key) const { return node_->find(key) != nullptr; }

bool StudyTable::is_text(const std::string& key) const { return node_->value(key).is_string(); }

std::string StudyTable::text(const std::string& key) const {
  return node_->scalar<std::string>(key, "a text in quotes");
}

std::string StudyTable::text_or(const std::string& key, const std::string& fallback) const {
  if (has(key)) return text(key);
  node_->record_default(key, fallback.empty() ? "-" : fallback);
  return fallback;
}

std::vector<std::string> StudyTable::texts(const std::string& key) const {
  std::vector<std::string> values;
  for (const toml::node& node : node_->array(key, 0)) {
    const auto value = node.value_exact<std::string>();
    if (!value) refuse(key, "expected a list of texts in quotes");
    values.push_back(*value);
  }
  return values;
}

std::vector<std::string> StudyTable::texts_or_none(const std::string& key) const {
  if (has(key)) return texts(key);
  node_->record_default(key, "-");
  return {};
}

bool StudyTable::flag_or(const std::string& key, bool fallback) const {
  if (has(key)) return node_->scalar<bool>(key, "true or false");
  node_->record_default(key, fallback ? "true" : "false");
  return fallback;
}

bool StudyTable::is_list(const std::string& key) const { return node_->value(key).is_array(); }

int StudyTable::count(const std::string& key, int least) const {
  const auto value = node_->scalar<std::int64_t>(key, "a whole number");
  if (value < least || value > std::numeric_limits<int>::max()) {
    refuse(key, "expected a whole number of at least " + std::to_string(least) + ", found " +
                    std::to_string(value));
  }
  return static_cast<int>(value);
}

int StudyTable::count_or(const std::string& key, int least, int fallback) const {
  if (has(key)) return count(key, least);
  node_->record_default(key, std::to_string(fallback));
  return fallback;
}

double StudyTable::number(const std::string& key) const {
  return node_->number_of(node_->value(key), key);
}

double StudyTable::number_or(const std::string& key, double fallback) const {
  if (has(key)) return number(key);
  node_->record_default(key, exact_text(fallback));
  return fallback;
}

std::vector<double> StudyTable::numbers(const std::string& key, std::size_t size) const {
  std::vector<double> values;
  for (const toml::node& node : node_->array(key, size)) {
    values.push_back(node_->number_of(node, key));
  }
  return values;
}

double StudyTable::quantity(const std::string& key, const std::string& si_unit) const {
  return node_->quantity_of(node_->value(key), key, si_unit);
}

double StudyTable::quantity_or(const std::string& key, const std::string& si_unit,
                               double fallback) const {
  if (has(key)) return quantity(key, si_unit);
  node_->record_default(key, exact_text(fallback) + " " + si_unit);
  return fallback;
}

std::vector<double> StudyTable::quantities(const std::string& key, const std::string& si_unit,
                                           std::size_t size) const {
  std::vector<double> values;
  for (const toml::node& node : node_->array(key, size)) {
    values.push_back(node_->quantity_of(node, key, si_unit));
  }
  return values;
}

StudyTable StudyTable::table(const std::string& key) const {
  auto child = std::make_shared<Node>();
  child->records = node_->records;
  child->path = node_->holder(key).dotted(key);
  if (const toml::node* const node = node_->find(key)) {
    child->table = node->as_table();
    if (child->table == nullptr) refuse(key, "expected a table [" + child->path + "]");
  }
  return StudyTable(std::move(child));
}

std::vector<StudyTable> StudyTable::tables(const std::string& key) const {
  std::vector<StudyTable> result;
  const toml::node* const node = node_->find(key);
  if (node == nullptr) return result;
  if (!node->is_array_of_tables()) refuse(key, "expected tables [[" + node_->dotted(key) + "]]");
  for (const toml::node& element : *node->as_array()) {
    auto child = std::make_shared<Node>();
    child->records = node_->records;
    child->table = element.as_table();
    const std::string name = (*child->table)["name"].value_or(std::to_string(result.size() + 1));
    child->path = node_->dotted(key) + "." + name;
    result.emplace_back(std::move(child));
  }
  return result;
}

std::vector<std::string> StudyTable::keys() const {
  std::vector<std::string> names;
  if (node_->table == nullptr) return names;
  for (const auto& [key, ignored] : *node_->table) names.emplace_back(key.str());
  return names;
}

StudyTable StudyTable::over(const StudyTable& below) const {
  auto node = std::make_shared<Node>(*node_);
  node->below = below.node_;
  return StudyTable(std::move(node));
}

std::filesystem::path StudyTable::folder_of(const std::string& key) const {
  const toml::node& node = node_->value(key);
  return node.source().path ? std::filesystem::path(*node.source().path).parent_path()
                            : std::filesystem::current_path();
}

void StudyTable::finish() const {
  for (const std::string& key : keys()) {
    if (std::find(node_->known.begin(), node_->known.end(), key) != node_->known.end()) continue;
    refuse(key, "unknown key" + did_you_mean(node_->known, key));
  }
}

void StudyTable::refuse(const std::string& key, const std::string& problem) const {
  node_->refuse(key, problem);
}

StudyDocument::StudyDocument(const std::filesystem::path& path,
                             const std::vector<std::string>& settings)
    : impl_(std::make_shared<Impl>()) {
  impl_->root = parse_with_includes(path, impl_->files);
  for (const std::string& setting : settings) apply_setting(impl_->root, setting);
}

StudyTable StudyDocument::root() const {
  auto node = std::make_shared<StudyTable::Node>();
  node->table = &impl_->root;
  // Shares the ownership of the document: a table may outlive it.
  node->records = std::shared_ptr<Records>(impl_, &impl_->records);
  return StudyTable(std::move(node));
}

const std::vector<InputFile>& StudyDocument::files() const { return impl_->files; }
const std::vector<Parameter>& StudyDocument::parameters() const {
  return impl_->records.parameters;
}
const std::vector<Parameter>& StudyDocument::defaults() const { return impl_->records.defaults; }

}  // namespace flexneck::pipeline
