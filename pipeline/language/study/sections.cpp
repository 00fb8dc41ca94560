// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/sections.h"

#include <algorithm>

#include "geometry/foundation/error.h"
#include "geometry/foundation/names.h"
#include "pipeline/language/model/model_sections.h"

namespace flexneck::pipeline {

namespace {

/// A table of a section, merged with those below it.
struct Element {
  std::string name;
  StudyTable table;
  bool is_of_case = false;
};

bool is_named(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string name_in(const std::string& section, const StudyTable& table) {
  return section == "marker" ? table.text("body") + "." + table.text("name") : table.text("name");
}

/// Checks the keys of a table that others override, since its reader then does not see all of it.
void require_known_keys(const StudyTable& table) {
  for (const std::string& key : table.keys())
    if (find_key(table.key_rows(), key) == nullptr) table.refuse(key, "unknown key");
}

std::vector<Element> elements(const std::string& section, const std::vector<StudyTable>& of_study,
                              const std::vector<StudyTable>& layers) {
  std::vector<Element> all;
  all.reserve(of_study.size());
  for (const StudyTable& table : of_study) all.push_back({name_in(section, table), table});
  for (const StudyTable& layer : layers) {
    for (const StudyTable& own : layer.tables(section)) {
      const std::string name = name_in(section, own);
      const auto below = std::find_if(all.begin(), all.end(),
                                      [&](const Element& each) { return each.name == name; });
      if (below == all.end()) {
        all.push_back({name, own, true});
      } else {
        if (below->is_of_case) require_known_keys(below->table);
        *below = {name, own.over(below->table), true};
      }
    }
  }
  return all;
}

/// The part of a marker's name before the dot.
std::string body_of(const std::string& marker) { return marker.substr(0, marker.find('.')); }

/// True if an element of the study belongs to a case whose preceding sections have been read.
bool is_taken(const std::string& section, const Element& element, const CaseTables& experiment,
              const multibody::Model& model) {
  const StudyTable& table = element.table;
  const auto has_body = [&](const std::string& name) {
    return is_named(names_of(model.bodies), name);
  };
  if (element.is_of_case) return true;
  if (section == "body")
    return experiment.bodies.empty() || is_named(experiment.bodies, element.name);
  if (section == "marker") return has_body(table.text("body"));
  if (section == "joint")
    return has_body(body_of(table.text("lower"))) && has_body(body_of(table.text("upper")));
  if (section == "motor") return is_named(names_of(model.joints), table.text("joint"));
  return is_named(experiment.forces, element.name);
}

/// Checks the names of bodies or forces.
/// @throws InputError for a name that no element of the kind has.
void require_names(const CaseTables& experiment, const std::string& key,
                   const std::vector<std::string>& names, const std::vector<std::string>& all) {
  if (names.empty()) return;
  for (const std::string& name : names)
    at_key(experiment.layers.back(), key,
           [&] { return find_name(all, name, key == "bodies" ? "body" : "force"); });
}

}  // namespace

StudyModels::StudyModels(const StudyTable& root, std::vector<std::string> interfaces)
    : interfaces_(std::move(interfaces)) {
  for (const ModelSection& section : model_sections()) {
    const std::string name(section.key.name);
    sections_[name] = root.tables(name);
  }
}

Assembly StudyModels::whole(double end_time_s, double resolution_s) const {
  Assembly assembly;
  assembly.end_time_s = end_time_s;
  assembly.resolution_s = resolution_s;
  assembly.structure = interfaces_;
  assembly.motion = Assembly::Motion::optional;
  for (const ModelSection& section : model_sections())
    for (const StudyTable& table : sections_.at(std::string(section.key.name)))
      section.read(table, assembly);
  check_names(names_of(assembly.model.bodies), "body");
  check_names(names_of(assembly.model.markers), "marker");
  check_names(names_of(assembly.model.joints), "joint");
  return assembly;
}

Assembly StudyModels::of_case(const CaseTables& experiment, Assembly begun) const {
  begun.structure = interfaces_;
  std::vector<std::string> bodies;
  std::vector<std::string> forces;
  for (const ModelSection& section : model_sections()) {
    const std::string name(section.key.name);
    for (const Element& each : elements(name, sections_.at(name), experiment.layers)) {
      if (name == "body")
        bodies.push_back(each.name);
      else if (name != "marker" && name != "joint" && name != "motor")
        forces.push_back(each.name);
      if (is_taken(name, each, experiment, begun.model)) section.read(each.table, begun);
    }
    if (name == "body") require_names(experiment, "bodies", experiment.bodies, bodies);
  }
  require_names(experiment, "forces", experiment.forces, forces);
  return begun;
}

}  // namespace flexneck::pipeline
