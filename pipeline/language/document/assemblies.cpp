// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/assemblies.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <toml++/toml.h>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/language/document/toml_nodes.h"
#include "pipeline/language/document/toml_source.h"
#include "pipeline/language/document/variables.h"

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
    refuse_at(
        node, name,
        expected + ", [[assembly]] or [variables] in the file of an assembly, found another key");
  }
}

/// Prefixes "<assembly>:" to the names of all bodies, joints, forces and so on that a file defines,
/// and to references to them. A name that the file does not define is unchanged: it refers to the
/// file that holds the assembly. For a marker on a body of that file the marker's own name gets the
/// prefix, as in "pelvis.left_leg:hip".
/// @throws InputError for sections that an assembly cannot have, such as [solver]
void prefix_names(toml::table& content, const std::string& assembly) {
  check_sections(content);
  Names names(content, assembly + ":");
  for (const Section& section : sections())
    for_each_table(content, section, [&](toml::table& table) {
      names.rename(table, section);
      for (const Reference& reference : section.references) names.redirect(table, reference);
    });
}

/// Adds the tables of an assembly to those of the file that holds it.
/// @throws InputError if the holder uses the name of a section for something else
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

}  // namespace

namespace fs = std::filesystem;

namespace {

constexpr Key kVariablesKeys[] = {
    Key::number_or_quantity(
        "*", "", kRequired,
        "A number, or a number with its unit, that values refer to as \"$name\""),
};

constexpr Key kAssemblyKeys[] = {
    Key::text("name", kRequired,
              "Name of the assembly; its tables are referred to as name:table_name"),
    Key::file("file", kRequired,
              "Model file whose bodies, joints, forces and channels are added to this model"),
    Key::table("variables", "Values that replace those of [variables] in that file",
               kVariablesKeys),
};

/// Removes and returns the settings whose keys begin with `beginning`.
std::vector<std::string> taken(std::vector<std::string>& settings, const std::string& beginning) {
  const auto others = std::stable_partition(
      settings.begin(), settings.end(),
      [&](const std::string& setting) { return !setting.starts_with(beginning); });
  std::vector<std::string> result(std::make_move_iterator(others),
                                  std::make_move_iterator(settings.end()));
  settings.erase(others, settings.end());
  return result;
}

class Reading {
 public:
  Reading(const std::vector<std::string>& settings, std::span<const Key> keys)
      : keys_(keys), settings_(settings) {}

  DocumentContent document(const DocumentSource& source) {
    toml::table& root = content_.root;
    root = file(source);
    for (const std::string& setting : taken(settings_, "variables.")) apply_setting(root, setting);
    Variables variables(taken_table(root, "variables", "variables"), "variables");
    variables.substitute(root);
    expand(root, "", variables);
    for (const std::string& setting : taken(settings_, "assembly."))
      throw InputError("--set " + setting + ": there is no [[assembly]] with this name");
    for (const std::string& setting : settings_) apply_setting(root, setting);
    variables.substitute(root);  // which settings may use, too
    record(variables);
    return std::move(content_);
  }

 private:
  /// Parses a file with its includes; it counts as open until close().
  toml::table file(const DocumentSource& source) {
    std::vector<InputFile> read;
    toml::table table = parse_with_includes(source, read);
    open_.push_back(fs::weakly_canonical(source.path));
    count_ += read.size();
    for (InputFile& each : read)
      if (std::none_of(content_.files.begin(), content_.files.end(), [&](const InputFile& other) {
            return other.name == each.name && other.hash == each.hash;
          }))
        content_.files.push_back(std::move(each));
    return table;
  }

  void record(const Variables& variables) {
    variables.finish();
    for (Parameter& each : variables.parameters()) content_.parameters.push_back(std::move(each));
  }

  /// Replaces the assemblies of a file by their content.
  void expand(toml::table& holder, const std::string& prefix, Variables& scope) {
    toml::node* const node = holder.get("assembly");
    if (node == nullptr) return;
    if (!node->is_array_of_tables()) refuse_at(*node, "assembly", "expected tables [[assembly]]");
    toml::array assemblies = std::move(*node->as_array());
    holder.erase("assembly");
    std::vector<std::string> names;
    for (std::size_t k = 0; k < assemblies.size(); ++k) {
      toml::table& table = *assemblies[k].as_table();
      const std::string key = element_path("assembly", table, k);
      names.push_back(text(table, "name", key));
      check_name(table, names, key);
      const std::string full = prefix + names.back();
      const std::string beginning = "assembly." + full + ".";
      for (const std::string& setting : taken(settings_, beginning))
        apply_setting(table, setting.substr(beginning.size()));
      scope.substitute(table);
      toml::table content = instance(table, full);
      prefix_names(content, names.back());
      append_sections(holder, std::move(content));
    }
  }

  /// Content of an assembly's file, with the names used in that file.
  /// @param name  with the prefixes of the enclosing assemblies
  toml::table instance(toml::table& assembly, const std::string& name) {
    const std::string key = "assembly." + name;
    check_keys(assembly, key);
    const fs::path path = path_of(assembly, key);
    check_depth(assembly, path, key);
    content_.parameters.push_back(
        {key + ".file", text(assembly, "file", key), Origin::synthetic, {}});
    toml::table content = file(path);
    const std::string own = key + ".variables";
    toml::table given = taken_table(content, "variables", "variables");
    override_variables(given, taken_table(assembly, "variables", own), own, path);
    Variables variables(std::move(given), own);
    variables.substitute(content);
    expand(content, name + ":", variables);
    record(variables);
    open_.pop_back();
    return content;
  }

  static std::string text(toml::table& table, const std::string& which, const std::string& key) {
    const toml::value<std::string>* const node = text_node(table, which);
    if (node == nullptr) refuse_at(table, key + "." + which, "expected a text in quotes");
    return node->get();
  }

  static void check_name(const toml::table& table, const std::vector<std::string>& names,
                         const std::string& key) {
    const std::string& name = names.back();
    if (name.empty() || name.find_first_of(".:/") != std::string::npos)
      refuse_at(table, key + ".name",
                "expected a name without '.', ':' and '/', found '" + name + "'");
    if (std::count(names.begin(), names.end(), name) > 1)
      refuse_at(table, key + ".name", "expected a unique name, found that of another assembly");
  }

  static void check_keys(const toml::table& assembly, const std::string& key) {
    std::vector<std::string> known;
    for (const Key& row : kAssemblyKeys) known.emplace_back(row.name);
    for (const auto& [each, node] : assembly) {
      const std::string found(each.str());
      if (std::find(known.begin(), known.end(), found) == known.end())
        refuse_at(node, key + "." + found, "unknown key" + did_you_mean(known, found));
    }
  }

  /// Path of an assembly's file: relative to the file that names it, or a shipped file.
  static fs::path path_of(toml::table& assembly, const std::string& key) {
    const std::string name = text(assembly, "file", key);
    const toml::source_path_ptr& from = text_node(assembly, "file")->source().path;
    const fs::path folder = from ? fs::path(*from).parent_path() : fs::path();
    try {
      return named_file(name, folder);
    } catch (const InputError&) {
      return folder / name;  // refused when it is opened
    }
  }

  void check_depth(toml::table& assembly, const fs::path& path, const std::string& key) const {
    const std::string place = key + ".file";
    std::error_code error;
    const fs::path canonical = fs::weakly_canonical(path, error);
    if (!error && std::find(open_.begin(), open_.end(), canonical) != open_.end())
      refuse_at(assembly, place, "expected another file, found one that contains this assembly");
    if (!fs::exists(path, error))
      refuse_at(*text_node(assembly, "file"), place,
                "expected a file, but there is none with the name " + path.string());
    if (open_.size() >= kDeepestInclude || count_ >= kMaxFiles)
      refuse_at(assembly, place,
                "expected at most " + std::to_string(kMaxFiles) + " files, nested at most " +
                    std::to_string(kDeepestInclude) + " deep, found more");
  }

  static void override_variables(toml::table& given, toml::table&& over, const std::string& key,
                                 const fs::path& path) {
    const std::vector<std::string> names = keys_of(given);
    for (auto&& [each, node] : over) {
      const std::string name(each.str());
      if (!given.contains(name))
        refuse_at(node, key + "." + name,
                  "expected a variable of " + path.string() + ", found an unknown name" +
                      did_you_mean(names, name));
      node.visit([&](auto& value) { given.insert_or_assign(name, std::move(value)); });
    }
  }

  std::span<const Key> keys_;
  std::vector<std::string> settings_;  ///< not applied yet
  DocumentContent content_;
  std::vector<fs::path> open_;  ///< the file being read and the files whose assembly it is
  std::size_t count_ = 0;       ///< number of files read
};

}  // namespace

Key variables_key() {
  return Key::table("variables", "Named values from which other values are computed",
                    kVariablesKeys);
}

Key assembly_key() {
  return Key::tables("assembly", "Models that are included in this one, with their names prefixed",
                     kAssemblyKeys);
}

DocumentContent read_document(const DocumentSource& source,
                              const std::vector<std::string>& settings, std::span<const Key> keys) {
  return Reading(settings, keys).document(source);
}

}  // namespace flexneck::pipeline
