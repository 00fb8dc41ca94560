// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/assembly_names.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "pipeline/language/document/toml_nodes.h"

namespace flexneck::pipeline {

namespace {

enum class Thing { none, body, marker, joint };

struct Reference {
  std::string_view key;
  Thing thing;
};

/// A section that an assembly may have, the thing that its tables name, and their references.
struct Section {
  std::string_view name;
  Thing named;  ///< the kind of thing that its "name" identifies; none if no table refers to it
  std::vector<Reference> references;
};

const std::vector<Section>& sections() {
  using enum Thing;
  static const std::vector<Section> kSections = {
      {"body", body, {}},
      {"marker", marker, {{"body", body}}},
      {"joint", joint, {{"lower", marker}, {"upper", marker}}},
      {"motor", none, {{"joint", joint}}},
      {"force", none, {{"marker", marker}}},
      {"torque", none, {{"marker", marker}}},
      {"spring", none, {{"lower", marker}, {"upper", marker}}},
      {"bushing", none, {{"lower", marker}, {"upper", marker}}},
      {"section", none, {{"lower", marker}, {"upper", marker}}},
      {"line_force", none, {{"lower", marker}, {"upper", marker}}},
      {"cable", none, {{"lower", marker}, {"upper", marker}}},
      {"function_force", none, {{"lower", marker}, {"upper", marker}}},
      {"resistance", none, {{"joint", joint}}},
      {"channel",
       none,
       {{"body", body},
        {"marker", marker},
        {"relative_to", marker},
        {"axes", marker},
        {"joint", joint}}},
  };
  return kSections;
}

/// Tables of a section; null if there is none.
toml::array* tables_of(toml::table& content, std::string_view section) {
  toml::node* const node = content.get(section);
  if (node == nullptr) return nullptr;
  if (!node->is_array_of_tables())
    refuse_at(*node, std::string(section), "expected tables [[" + std::string(section) + "]]");
  return node->as_array();
}

template <class Visit>
void for_each_table(toml::table& content, const Section& section, const Visit& visit) {
  if (toml::array* const tables = tables_of(content, section.name))
    for (toml::node& node : *tables) visit(*node.as_table());
}

/// New names keyed by the names in the file.
class Names {
 public:
  Names(toml::table& content, std::string prefix) : prefix_(std::move(prefix)) {
    for (const Section& section : sections()) {
      if (section.named != Thing::body && section.named != Thing::joint) continue;
      for_each_table(content, section, [&](toml::table& table) {
        if (const auto* const text = text_node(table, "name"))
          names_[section.named][text->get()] = prefix_ + text->get();
      });
    }
  }

  /// Prefixes a table's name. Markers come before the tables that refer to them.
  void rename(toml::table& table, const Section& section) {
    toml::value<std::string>* const name = text_node(table, "name");
    if (name == nullptr) return;  // The reader reports the missing name.
    if (section.named == Thing::marker) {
      const auto* const body = text_node(table, "body");
      if (body == nullptr || names_[Thing::body].contains(body->get())) return;
      names_[Thing::marker][body->get() + "." + name->get()] =
          body->get() + "." + prefix_ + name->get();
    }
    name->get() = prefix_ + name->get();
  }

  void redirect(toml::table& table, const Reference& reference) {
    toml::value<std::string>* const text = text_node(table, std::string(reference.key));
    if (text == nullptr) return;
    const auto found = names_[reference.thing].find(text->get());
    if (found != names_[reference.thing].end())
      text->get() = found->second;
    else if (reference.thing == Thing::marker && is_on_body(text->get()))
      text->get() = prefix_ + text->get();
  }

 private:
  /// True if "body.marker" is on a body of the file; interfaces are markers without a table.
  bool is_on_body(const std::string& marker) {
    for (std::size_t dot = marker.find('.'); dot != std::string::npos;
         dot = marker.find('.', dot + 1))
      if (names_[Thing::body].contains(marker.substr(0, dot))) return true;
    return false;
  }

  std::string prefix_;
  std::map<Thing, std::map<std::string, std::string>> names_;
};

void check_sections(const toml::table& content) {
  for (const auto& [key, node] : content) {
    const std::string name(key.str());
    const bool is_known = std::any_of(sections().begin(), sections().end(),
                                      [&](const Section& section) { return section.name == name; });
    if (is_known) continue;
    std::string expected = "expected tables";
    for (const Section& section : sections()) expected += " [[" + std::string(section.name) + "]]";
    refuse_at(node, name,
              expected + ", [[assembly]] or [variables] in the file of an assembly, found another");
  }
}

}  // namespace

void prefix_names(toml::table& content, const std::string& assembly) {
  check_sections(content);
  Names names(content, assembly + ":");
  for (const Section& section : sections())
    for_each_table(content, section, [&](toml::table& table) {
      names.rename(table, section);
      for (const Reference& reference : section.references) names.redirect(table, reference);
    });
}

void append_sections(toml::table& holder, toml::table&& content) {
  for (auto&& [key, node] : content) {
    const std::string name(key.str());
    if (!holder.contains(name)) {
      holder.insert(name, std::move(*node.as_array()));
      continue;
    }
    toml::array* const tables = tables_of(holder, name);
    for (toml::node& each : *node.as_array()) tables->push_back(std::move(*each.as_table()));
  }
}

}  // namespace flexneck::pipeline
