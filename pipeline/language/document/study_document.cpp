// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/study_document.h"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/language/document/assemblies.h"
#include "pipeline/language/document/study_node.h"
#include "pipeline/language/document/toml_source.h"

namespace flexneck::pipeline {

struct StudyDocument::Impl {
  DocumentContent content;
  std::span<const Key> keys;
  StudyRecords records;
};

namespace {

/// Unit of a quantity; the reader chooses it where kinds with different dimensions share the key.
std::string unit_in(const Key& row, const std::string& wanted) {
  std::string_view rest = row.unit;
  if (wanted.empty() && rest.find('|') == std::string_view::npos) return std::string(rest);
  for (std::size_t bar = 0; bar != std::string_view::npos;) {
    bar = rest.find(" | ");
    if (rest.substr(0, bar) == wanted) return wanted;
    if (bar != std::string_view::npos) rest.remove_prefix(bar + 3);
  }
  throw std::logic_error("the table of keys has no unit '" + wanted + "' for " +
                         std::string(row.name));
}

}  // namespace

StudyTable::StudyTable(std::shared_ptr<Node> node) : node_(std::move(node)) {}

bool StudyTable::has(const std::string& key) const {
  node_->row(key);
  return node_->find(key) != nullptr;
}

bool StudyTable::is_text(const std::string& key) const { return node_->value(key).is_string(); }

std::string StudyTable::text(const std::string& key) const {
  const Key& row = node_->row(key, KeyType::text);
  if (node_->falls_back(key, row)) return row.fallback == kNone ? "" : std::string(row.fallback);
  return node_->scalar<std::string>(key, "a text in quotes");
}

std::string StudyTable::text_or(const std::string& key, const std::string& fallback) const {
  if (has(key)) return text(key);
  node_->record_default(key, fallback.empty() ? std::string(kNone) : fallback);
  return fallback;
}

std::size_t StudyTable::choice(const std::string& key) const {
  const std::vector<std::string> names = node_->row(key).details.choices();
  const std::string name = text(key);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  std::string expected = "expected one of";
  for (const std::string& each : names) expected += " \"" + each + "\"";
  refuse(key, expected + ", found \"" + name + "\"" + did_you_mean(names, name));
}

std::vector<std::string> StudyTable::texts(const std::string& key) const {
  if (node_->falls_back(key, node_->row(key, KeyType::texts))) return {};
  std::vector<std::string> values;
  for (const toml::node& node : node_->array(key, 0)) {
    const auto value = node.value_exact<std::string>();
    if (!value) refuse(key, "expected a list of texts in quotes");
    values.push_back(*value);
  }
  return values;
}

bool StudyTable::flag(const std::string& key) const {
  const Key& row = node_->row(key, KeyType::flag);
  if (node_->falls_back(key, row)) return row.fallback == "true";
  return node_->scalar<bool>(key, "true or false");
}

bool StudyTable::is_list(const std::string& key) const { return node_->value(key).is_array(); }

int StudyTable::count(const std::string& key) const {
  const Key& row = node_->row(key, KeyType::count);
  if (node_->falls_back(key, row)) return static_cast<int>(fallback_number(row.fallback));
  const auto value = node_->scalar<std::int64_t>(key, "a whole number");
  const Range& range = row.details.range;
  if (!range.contains(static_cast<double>(value)) || value > std::numeric_limits<int>::max()) {
    refuse(key, "expected a whole number of at least " + exact_text(range.low) + ", found " +
                    std::to_string(value));
  }
  return static_cast<int>(value);
}

int StudyTable::count_or(const std::string& key, int fallback) const {
  if (has(key)) return count(key);
  node_->record_default(key, std::to_string(fallback));
  return fallback;
}

double StudyTable::number(const std::string& key) const {
  const Key& row = node_->row(key, KeyType::number);
  if (node_->falls_back(key, row)) return fallback_number(row.fallback);
  const double value = node_->number_of(node_->value(key), key);
  node_->require_within(key, row.details.range, value);
  return value;
}

double StudyTable::number_or(const std::string& key, double fallback) const {
  if (has(key)) return number(key);
  node_->record_default(key, exact_text(fallback));
  return fallback;
}

std::vector<double> StudyTable::numbers(const std::string& key, std::size_t size) const {
  const Range& range = node_->row(key, KeyType::numbers).details.range;
  std::vector<double> values;
  for (const toml::node& node : node_->array(key, size)) {
    values.push_back(node_->number_of(node, key));
    node_->require_within(key, range, values.back());
  }
  return values;
}

double StudyTable::quantity(const std::string& key, const std::string& unit) const {
  const Key& row = node_->row(key, KeyType::quantity);
  const std::string si_unit = unit_in(row, unit);
  if (node_->falls_back(key, row, si_unit)) return fallback_number(row.fallback);
  const double value = node_->quantity_of(node_->value(key), key, si_unit);
  node_->require_within(key, row.details.range, value);
  return value;
}

std::vector<double> StudyTable::quantities(const std::string& key, std::size_t size,
                                           const std::string& unit) const {
  const Key& row = node_->row(key, KeyType::quantities);
  const std::string si_unit = unit_in(row, unit);
  std::vector<double> values;
  for (const toml::node& node : node_->array(key, size)) {
    values.push_back(node_->quantity_of(node, key, si_unit));
    node_->require_within(key, row.details.range, values.back());
  }
  return values;
}

std::filesystem::path StudyTable::file(const std::string& key) const {
  node_->row(key, KeyType::file);
  return folder_of(key) / node_->scalar<std::string>(key, "a text in quotes");
}

StudyTable StudyTable::table(const std::string& key) const {
  auto child = std::make_shared<Node>();
  child->records = node_->records;
  child->keys = node_->row(key, KeyType::table).keys;
  child->path = node_->holder(key).dotted(key);
  if (const toml::node* const node = node_->find(key)) {
    child->table = node->as_table();
    if (child->table == nullptr) refuse(key, "expected a table [" + child->path + "]");
  }
  return StudyTable(std::move(child));
}

std::vector<StudyTable> StudyTable::tables(const std::string& key) const {
  std::vector<StudyTable> result;
  const std::span<const Key> rows = node_->row(key, KeyType::tables).keys;
  const toml::node* const node = node_->find(key);
  if (node == nullptr) return result;
  // `test = []` in a file removes the tables of the files that it includes.
  if (node->is_array() && node->as_array()->empty()) return result;
  if (!node->is_array_of_tables()) refuse(key, "expected tables [[" + node_->dotted(key) + "]]");
  std::map<std::string, int> seen;
  for (const toml::node& element : *node->as_array()) {
    auto child = std::make_shared<Node>();
    child->records = node_->records;
    child->keys = rows;
    child->table = element.as_table();
    std::string name = (*child->table)["name"].value_or(std::to_string(result.size() + 1));
    // Markers of different bodies, say, may share a name: none of their values may be lost among
    // the parameters.
    if (const int count = ++seen[name]; count > 1) name += "#" + std::to_string(count);
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
    refuse(key, node_->unknown(key));
  }
}

void StudyTable::refuse(const std::string& key, const std::string& problem) const {
  node_->refuse(key, problem);
}

void StudyTable::refuse_given(const std::vector<std::string>& keys,
                              const std::string& problem) const {
  for (const std::string& key : keys)
    if (has(key)) refuse(key, problem);
}

std::span<const Key> StudyTable::key_rows() const { return node_->keys; }

StudyDocument::StudyDocument(const DocumentSource& source, const std::vector<std::string>& settings,
                             std::span<const Key> keys)
    : impl_(std::make_shared<Impl>()) {
  impl_->keys = keys;
  impl_->content = read_document(source, settings, keys);
  impl_->records.parameters = impl_->content.parameters;
}

StudyTable StudyDocument::root() const {
  auto node = std::make_shared<StudyTable::Node>();
  node->table = &impl_->content.root;
  node->keys = impl_->keys;
  impl_->records.format = impl_->keys;
  // Shares ownership of the document, since a table may outlive it.
  node->records = std::shared_ptr<StudyRecords>(impl_, &impl_->records);
  return StudyTable(std::move(node));
}

void StudyDocument::set(const std::string& setting) {
  apply_setting(impl_->content.root, setting);
  impl_->records = {impl_->keys, impl_->content.parameters, {}};
}

const std::vector<InputFile>& StudyDocument::files() const { return impl_->content.files; }
const std::vector<Parameter>& StudyDocument::parameters() const {
  return impl_->records.parameters;
}
const std::vector<Parameter>& StudyDocument::defaults() const { return impl_->records.defaults; }

}  // namespace flexneck::pipeline
