// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "geometry/foundation/error.h"
#include "pipeline/document/table_values.h"
#include "pipeline/study/sections.h"

namespace flexneck::pipeline {

namespace {

geometry::NeckParameters read_neck(const StudyTable& table) {
  geometry::NeckParameters neck;
  for (const geometry::NeckDimension& dimension : geometry::neck_dimensions()) {
    neck.*dimension.member = table.quantity(dimension.name, "m");
  }
  return neck;
}

geometry::SlitState read_slit_state(const StudyTable& table) {
  using geometry::SlitState;
  constexpr std::array kStates = {SlitState::none, SlitState::closed, SlitState::open};
  return kStates.at(choice_or_first(table, "slits", {"none", "closed", "open"}));
}

geometry::NeckSlits read_slits(const StudyTable& table) {
  geometry::NeckSlits slits;
  slits.state = read_slit_state(table);
  if (table.has("slit_parts")) slits.parts = table.texts("slit_parts");
  if (choice_or_first(table, "slit_edge", {"ring", "chord"}) == 1) {
    table.refuse("slit_edge",
                 "the neck's O-grid has rings and spokes but no straight chord that a slit could "
                 "end on; take \"ring\", or a script of your own that draws one");
  }
  if (table.has("slit_depth")) slits.depth = table.number("slit_depth");
  return slits;
}

mesher::ElementKind read_element(const StudyTable& table) {
  using mesher::ElementKind;
  constexpr std::array kKinds = {ElementKind::hex27, ElementKind::hex20, ElementKind::hex8,
                                 ElementKind::tet10};
  return kKinds.at(choice_or_first(table, "element", {"hex27", "hex20", "hex8", "tet10"}));
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
  const auto take = [&](const std::string& key, int& value) {
    value = table.count_or(key, 1, value);
  };
  take("quadrant", divisions.quadrant);
  take("inner_ring", divisions.inner_ring);
  take("outer_ring", divisions.outer_ring);
  take("rubber_layers", divisions.rubber_layers);
  take("plate_layers", divisions.plate_layers);
  take("end_plate_layers", divisions.end_plate_layers);
  divisions.ring_grading = table.number_or("ring_grading", divisions.ring_grading);
  divisions.rubber_grading = table.number_or("rubber_grading", divisions.rubber_grading);
  divisions.refine = table.count_or("refine", 0, divisions.refine);
  return divisions;
}

/// Whether a file of another folder than that of the fit gives a dimension or a material: the fit
/// was to the values that stand beside it.
bool has_values_from_elsewhere(const StudyTable& geometry) {
  const std::filesystem::path folder = geometry.folder_of("fitted_to");
  for (const geometry::NeckDimension& dimension : geometry::neck_dimensions())
    if (geometry.folder_of(dimension.name) != folder) return true;
  const StudyTable materials = geometry.table("materials");
  for (const std::string& name : materials.keys())
    for (const char* const key : {"youngs_modulus", "poissons_ratio", "density"})
      if (materials.table(name).folder_of(key) != folder) return true;
  return geometry.folder_of("joint_point") != folder;
}

}  // namespace

MaterialModels read_materials(const StudyTable& geometry, std::vector<mesher::Material>& materials,
                              std::map<std::string, std::string>& material_of_part) {
  MaterialModels models;
  const StudyTable table = geometry.table("materials");
  for (const std::string& name : table.keys()) {
    const StudyTable material = table.table(name);
    materials.push_back({name, material.quantity("youngs_modulus", "Pa"),
                         material.number("poissons_ratio"),
                         material.quantity("density", "kg/m^3")});
    MaterialModel& model = models[name];
    if (material.has("formulation")) model.formulation = read_formulation(material);
    model.static_modulus_ratio = material.number_or("static_modulus_ratio", 1);
    if (!(model.static_modulus_ratio > 0)) {
      material.refuse("static_modulus_ratio", "expected a positive number");
    }
    for (const std::string& part : material.texts("parts")) {
      if (!material_of_part.emplace(part, name).second) {
        material.refuse("parts", "the part '" + part + "' has another material already");
      }
    }
    material.finish();
  }
  return models;
}

void read_script_options(const StudyTable& geometry, const StudyTable& mesh,
                         mesher::ScriptMeshOptions& options) {
  if (mesh.has("element")) options.element = read_element(mesh);
  const geometry::SlitState state = read_slit_state(geometry);
  const std::vector<std::string> faces = geometry.texts_or_none("slit_faces");
  if (state == geometry::SlitState::none) return;
  if (faces.empty()) {
    geometry.refuse("slit_faces",
                    "slits need the script's physical surfaces that they lie on, found none");
  }
  options.slits = faces;
  options.slits_tied = state == geometry::SlitState::closed;
}

GeometrySection read_geometry(const StudyTable& geometry, const StudyTable& mesh) {
  GeometrySection section;
  section.script = geometry.folder_of("script") / geometry.text("script");
  section.neck = read_neck(geometry);
  section.slits = read_slits(geometry);
  const std::vector<double> point = geometry.quantities("joint_point", "m", 3);
  section.joint_point_m = Eigen::Map<const Eigen::Vector3d>(point.data());
  section.fitted_to = geometry.texts_or_none("fitted_to");
  section.material_models = read_materials(geometry, section.materials, section.material_of_part);
  if (!section.fitted_to.empty() && has_values_from_elsewhere(geometry)) section.fitted_to.clear();
  geometry.finish();
  section.divisions = read_divisions(mesh);
  section.element = read_element(mesh);
  mesh.finish();
  return section;
}

}  // namespace flexneck::pipeline
