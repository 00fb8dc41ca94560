// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/document/assemblies.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/language/document/assembly_names.h"
#include "pipeline/language/document/shipped_files.h"
#include "pipeline/language/document/toml_nodes.h"
#include "pipeline/language/document/toml_source.h"
#include "pipeline/language/document/variables.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

namespace {

constexpr Key kVariablesKeys[] = {
    Key::number_or_quantity("*", "", kRequired,
                            "A number, or a number with its unit, that values name as \"$name\""),
};

constexpr Key kAssemblyKeys[] = {
    Key::text("name", kRequired, "Name of the assembly; its tables are called name:their_name"),
    Key::file("file", kRequired, "Model file whose bodies, joints, forces and channels join"),
    Key::table("variables", "Values in place of those of that file's [variables]", kVariablesKeys),
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
      throw InputError("--set " + setting + ": there is no assembly of that name");
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
      refuse_at(table, key + ".name", "expected a name of its own, found that of another assembly");
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
      refuse_at(assembly, place, "expected another file, found one that holds this assembly");
    if (!fs::exists(path, error))
      refuse_at(*text_node(assembly, "file"), place,
                "expected a file, found none of the name " + path.string());
    if (open_.size() >= kDeepestInclude || count_ >= kMaxFiles)
      refuse_at(assembly, place,
                "expected at most " + std::to_string(kMaxFiles) + " files, and " +
                    std::to_string(kDeepestInclude) + " within one another, found more");
  }

  static void override_variables(toml::table& given, toml::table&& over, const std::string& key,
                                 const fs::path& path) {
    const std::vector<std::string> names = keys_of(given);
    for (auto&& [each, node] : over) {
      const std::string name(each.str());
      if (!given.contains(name))
        refuse_at(node, key + "." + name,
                  "expected a variable of " + path.string() + ", found another" +
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
  return Key::table("variables", "Values that others are made of", kVariablesKeys);
}

Key assembly_key() {
  return Key::tables("assembly", "Models that join this one, under names of their own",
                     kAssemblyKeys);
}

DocumentContent read_document(const DocumentSource& source,
                              const std::vector<std::string>& settings, std::span<const Key> keys) {
  return Reading(settings, keys).document(source);
}

}  // namespace flexneck::pipeline
