// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/neck_section.h"

#include <algorithm>
#include <array>
#include <map>

#include "geometry/foundation/content_hash.h"
#include "geometry/foundation/error.h"
#include "pipeline/language/study/sections.h"
#include "pipeline/language/study/study.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> slit_edges() { return {"ring", "chord"}; }

/// Keys of [geometry] besides the dimensions.
constexpr auto kGeometryKeys = std::to_array<Key>({
    Key::texts("slit_parts", kNone,
               "Rubber sections of the neck that have slits (default: rubber_2 and rubber_3)"),
    Key::text("slit_edge", "ring", "Shape of the inner edge of the neck's slits",
              {.choices = slit_edges}),
    Key::number("slit_depth", kNone,
                "Depth of the neck's slits, as a fraction of the rubber between rim and hole"),
    Key::texts("fitted_to", kNone, "Published figures to which the neck's dimensions were fitted"),
    Key::text("fitted_values", kNone,
              "Hash of the fitted values, written by 'flexneck fit'; if the values change, "
              "fitted_to no longer applies"),
});

constexpr Key kMeshKeys[] = {
    Key::text("preset", kNone, "Preset of the neck's mesh divisions: default or paper"),
    Key::count("quadrant", kNone, "Elements around a quarter of the circumference",
               {.range = at_least(1)}),
    Key::count("inner_ring", kNone,
               "Elements in radial direction from the hole to the rim of the rubber",
               {.range = at_least(1)}),
    Key::count("outer_ring", kNone,
               "Elements in radial direction from the rim of the rubber to the rim of the plates",
               {.range = at_least(1)}),
    Key::count("rubber_layers", kNone, "Elements through the height of a rubber section",
               {.range = at_least(1)}),
    Key::count("plate_layers", kNone, "Elements through the thickness of an intermediate plate",
               {.range = at_least(1)}),
    Key::count("end_plate_layers", kNone,
               "Elements through the thickness of the base plate and of the top plate",
               {.range = at_least(1)}),
    Key::number("ring_grading", kNone,
                "Size ratio of neighbouring elements, away from the rim of the rubber"),
    Key::number("rubber_grading", kNone,
                "Thickness ratio of neighbouring rubber layers, away from the bonded faces"),
    Key::count("refine", kNone, "Times that all divisions are doubled", {.range = at_least(0)}),
};

geometry::NeckParameters read_dimensions(const StudyTable& table) {
  geometry::NeckParameters neck;
  for (const geometry::NeckDimension& dimension : geometry::neck_dimensions()) {
    neck.*dimension.member = table.quantity(dimension.name);
  }
  return neck;
}

geometry::NeckSlits read_slits(const StudyTable& table) {
  geometry::NeckSlits slits;
  slits.state = read_slit_state(table);
  if (table.has("slit_parts")) slits.parts = table.texts("slit_parts");
  if (table.choice("slit_edge") == 1) {
    table.refuse("slit_edge",
                 "the O-grid mesh of the neck has no straight line on which a slit could end; use "
                 "\"ring\", or a gmsh script of your own that draws a chord");
  }
  if (table.has("slit_depth")) slits.depth = table.number("slit_depth");
  return slits;
}

geometry::NeckDivisions read_divisions(const StudyTable& table) {
  geometry::NeckDivisions divisions;
  if (table.has("preset")) {
    try {
      divisions = geometry::divisions_preset(table.text("preset"));
    } catch (const InputError& error) {
      table.refuse("preset", error.what());
    }
  }
  const auto take = [&](const std::string& key, int& value) { value = table.count_or(key, value); };
  take("quadrant", divisions.quadrant);
  take("inner_ring", divisions.inner_ring);
  take("outer_ring", divisions.outer_ring);
  take("rubber_layers", divisions.rubber_layers);
  take("plate_layers", divisions.plate_layers);
  take("end_plate_layers", divisions.end_plate_layers);
  divisions.ring_grading = table.number_or("ring_grading", divisions.ring_grading);
  divisions.rubber_grading = table.number_or("rubber_grading", divisions.rubber_grading);
  divisions.refine = table.count_or("refine", divisions.refine);
  return divisions;
}

/// Name of the interface with the head's joint, whose position the fits used.
constexpr const char* kHeadJoint = "top";

/// True if a file of another folder than the fit's gives a dimension, a material or the head's
/// joint: the fit used the values in its own folder.
bool has_values_from_elsewhere(const StudyTable& root) {
  const StudyTable geometry = root.table("geometry");
  const std::filesystem::path folder = geometry.folder_of("fitted_to");
  for (const geometry::NeckDimension& dimension : geometry::neck_dimensions())
    if (geometry.folder_of(dimension.name) != folder) return true;
  const StudyTable materials = geometry.table("materials");
  for (const std::string& name : materials.keys())
    for (const char* const key : {"youngs_modulus", "poissons_ratio", "density"})
      if (materials.table(name).folder_of(key) != folder) return true;
  for (const StudyTable& interface : root.tables("interface"))
    if (interface.text("name") == kHeadJoint && interface.folder_of("position") != folder)
      return true;
  return false;
}

/// True for a dimension or a material.
bool is_dimension_or_material(const Parameter& parameter) {
  const std::string& key = parameter.key;
  return key.starts_with("geometry.") && !key.ends_with(".script") &&
         !key.starts_with("geometry.fitted_") && !key.ends_with(".parts") &&
         !key.starts_with("geometry.slit");
}

/// True for a geometric value of the user's own. Slits change a structure only when they are open,
/// which one key states.
bool is_own_geometry(const Parameter& parameter) {
  if (parameter.origin != Origin::synthetic) return false;
  if (parameter.key == "geometry.slits") return parameter.value.find("open") != std::string::npos;
  return is_dimension_or_material(parameter);
}

/// True if a fit of the neck depends on a value.
bool is_of_fit(const Parameter& parameter) {
  return parameter.key == std::string("interface.") + kHeadJoint + ".position" ||
         is_dimension_or_material(parameter);
}

/// True for a value of the user's own on which the fit depends.
bool is_changed(const Parameter& parameter) {
  return is_of_fit(parameter) && parameter.origin == Origin::synthetic;
}

bool is_another_neck(const StudyTable& root, const std::vector<Parameter>& parameters,
                     const NeckSection& neck) {
  // Slits in other states change nothing.
  if (neck.slits.state == geometry::SlitState::open) return true;
  if (!neck.fitted_values.empty()) return neck.fitted_values != neck_values_hash(parameters);
  return has_values_from_elsewhere(root) ||
         std::any_of(parameters.begin(), parameters.end(), is_changed);
}

}  // namespace

std::span<const Key> neck_geometry_keys() {
  static const std::vector<std::string> meanings = [] {
    std::vector<std::string> all;
    for (const geometry::NeckDimension& dimension : geometry::neck_dimensions())
      all.push_back("Required for the built-in neck geometry: " + std::string(dimension.meaning));
    return all;
  }();
  static const std::vector<Key> keys = [] {
    std::vector<Key> all(kGeometryKeys.begin(), kGeometryKeys.end());
    for (std::size_t k = 0; k < meanings.size(); ++k)
      all.push_back(Key::quantity(geometry::neck_dimensions()[k].name, "m", kNone, meanings[k]));
    return all;
  }();
  return keys;
}

std::span<const Key> neck_mesh_keys() { return kMeshKeys; }

bool has_neck(const StudyTable& geometry) {
  const auto is_there = [&](const geometry::NeckDimension& dimension) {
    return geometry.has(dimension.name);
  };
  const std::span<const geometry::NeckDimension> all = geometry::neck_dimensions();
  return std::any_of(all.begin(), all.end(), is_there);
}

NeckSection read_neck(const StudyTable& geometry, const StudyTable& mesh) {
  NeckSection neck;
  neck.dimensions = read_dimensions(geometry);
  neck.slits = read_slits(geometry);
  neck.divisions = read_divisions(mesh);
  neck.fitted_to = geometry.texts("fitted_to");
  if (geometry.has("fitted_values")) neck.fitted_values = geometry.text("fitted_values");
  return neck;
}

void add_neck(const NeckSection& neck, mesher::ScriptMeshOptions& options) {
  options.constants = geometry::script_constants(neck.dimensions, neck.divisions);
  options.constants.merge(geometry::script_constants(neck.slits));
  if (options.element == mesher::ElementKind::tet10) options.constants["recombine"] = 0;
  options.slits = geometry::slit_face_sets(neck.slits);
  options.slits_tied = neck.slits.state == geometry::SlitState::closed;
  const auto centres = geometry::bolt_centres(neck.dimensions);
  options.patches = {
      {"bolts", "base", {centres.begin(), centres.end()}, neck.dimensions.bolt_patch_radius}};
}

void check_neck(const StudyTable& root, const NeckSection& neck) {
  geometry::check(neck.dimensions);
  geometry::check(neck.divisions);
  geometry::check(neck.slits, neck.divisions);
  if (root.table("modes").has("fixed")) return;
  throw InputError(
      "modes.fixed: expected the node sets that are fixed, such as [\"bolts\"] for the neck's "
      "bolts or [] for a free neck, found no such key");
}

std::string neck_values_hash(const std::vector<Parameter>& parameters) {
  // Values sorted by key, independently of their order in the files.
  std::map<std::string, std::string> values;
  for (const Parameter& each : parameters)
    if (is_of_fit(each)) values[each.key] = each.value;
  std::string text;
  for (const auto& [key, value] : values) text += key + '\n' + value + '\n';
  return hash_of_text(text);
}

std::string own_value_of_geometry(const std::vector<Parameter>& parameters) {
  const auto found = std::find_if(parameters.begin(), parameters.end(), is_own_geometry);
  return found == parameters.end() ? "" : found->key;
}

void forget_fit_of_changed_neck(const StudyTable& root, const std::vector<Parameter>& parameters,
                                NeckSection& neck) {
  if (!neck.fitted_to.empty() && is_another_neck(root, parameters, neck)) neck.fitted_to.clear();
}

}  // namespace flexneck::pipeline
