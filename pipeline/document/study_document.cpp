// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/document/study_document.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/foundation/names.h"
#include "geometry/foundation/output_file.h"
#include "pipeline/document/assemblies.h"
#include "pipeline/document/study_node.h"

namespace flexneck::pipeline {

struct StudyDocument::Impl {
  toml::table root;
  std::vector<InputFile> files;
  StudyRecords records;
};

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
  impl_->root = read_document(path, settings, impl_->files, impl_->records.parameters);
}

StudyTable StudyDocument::root() const {
  auto node = std::make_shared<StudyTable::Node>();
  node->table = &impl_->root;
  // Shares the ownership of the document: a table may outlive it.
  node->records = std::shared_ptr<StudyRecords>(impl_, &impl_->records);
  return StudyTable(std::move(node));
}

const std::vector<InputFile>& StudyDocument::files() const { return impl_->files; }
const std::vector<Parameter>& StudyDocument::parameters() const {
  return impl_->records.parameters;
}
const std::vector<Parameter>& StudyDocument::defaults() const { return impl_->records.defaults; }

}  // namespace flexneck::pipeline
