// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "geometry/foundation/error.h"
#include "pipeline/study/sections.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> slit_states() { return {"none", "closed", "open"}; }
std::vector<std::string> node_orders() { return {"none", "nested-dissection"}; }
std::vector<std::string> slit_edges() { return {"ring", "chord"}; }
std::vector<std::string> elements() { return {"hex27", "hex20", "hex8", "tet10"}; }

constexpr Key kMaterialKeys[] = {
    Key::quantity("youngs_modulus", "Pa", kRequired, "Young's modulus"),
    Key::number("poissons_ratio", kRequired, "Poisson's ratio"),
    Key::quantity("density", "kg/m^3", kRequired, "Density; a weight density is refused"),
    Key::texts("parts", kRequired, "Parts of the mesh that are made of it"),
    Key::text("formulation", kNone, "In place of that of [modes]", {.used_by = UsedBy::modes}),
    Key::number("static_modulus_ratio", "1",
                "Young's modulus in static tests over that of the modes",
                {.range = kPositive, .used_by = UsedBy::modes}),
};

constexpr Key kMaterialsKeys[] = {
    Key::table("*", "A material by its name", kMaterialKeys),
};

/// Besides those of the neck's dimensions and of other structures.
constexpr auto kGeometryKeys = std::to_array<Key>({
    Key::file("script", kNone, "gmsh script that draws and meshes the structure"),
    Key::table("materials", "Materials of the parts", kMaterialsKeys),
    Key::text("slits", "none", "Slits: not there, cut but tied shut, or open",
              {.choices = slit_states}),
    Key::texts(
        "slit_parts", kNone,
        "Of the neck: rubber sections that are slit; rubber_2 and rubber_3 if it is not there"),
    Key::text("slit_edge", "ring", "Of the neck: shape of the slits' inner edge",
              {.choices = slit_edges}),
    Key::number("slit_depth", kNone,
                "Of the neck: share of the rubber between rim and hole that is cut"),
    Key::texts("slit_faces", kNone, "Of other scripts: physical surfaces that the slits lie on"),
    Key::quantities("joint_point", "m", kNone,
                    "Of the neck, which needs it: head joint, for the mass properties about it",
                    {.size = 3}),
    Key::texts("fitted_to", kNone, "Published figures that the neck's dimensions were fitted to"),
});

constexpr Key kMeshKeys[] = {
    Key::numbers("partitions", kNone, "Numbers of processes to share the elements out to",
                 {.changes_results = false}),
    Key::text("node_order", "none", "Order of elimination stored with the mesh",
              {.choices = node_orders, .changes_results = false}),
    Key::text("element", "hex27", "Kind of element that a script's mesh has",
              {.choices = elements}),
    Key::quantity("size", "m", "0",
                  "Of STEP and BREP shapes: size of the elements; 0 is gmsh's choice",
                  {.range = at_least(0)}),
    Key::text("preset", kNone, "Divisions of the neck: default or paper"),
    Key::count("quadrant", kNone, "Elements round a quarter of the circumference",
               {.range = at_least(1)}),
    Key::count("inner_ring", kNone, "Elements from the hole to the rubber's rim",
               {.range = at_least(1)}),
    Key::count("outer_ring", kNone, "Elements from the rubber's rim to the plate's",
               {.range = at_least(1)}),
    Key::count("rubber_layers", kNone, "Elements through one rubber section",
               {.range = at_least(1)}),
    Key::count("plate_layers", kNone, "Elements through an intermediate plate",
               {.range = at_least(1)}),
    Key::count("end_plate_layers", kNone, "Elements through the base and the top plate",
               {.range = at_least(1)}),
    Key::number("ring_grading", kNone, "Ratio of neighbouring elements away from the rubber's rim"),
    Key::number("rubber_grading", kNone, "Ratio of neighbouring layers away from the bonds"),
    Key::count("refine", kNone, "Times that all divisions are doubled", {.range = at_least(0)}),
};

geometry::NeckParameters read_neck(const StudyTable& table) {
  geometry::NeckParameters neck;
  for (const geometry::NeckDimension& dimension : geometry::neck_dimensions()) {
    neck.*dimension.member = table.quantity(dimension.name);
  }
  return neck;
}

geometry::SlitState read_slit_state(const StudyTable& table) {
  using geometry::SlitState;
  constexpr std::array kStates = {SlitState::none, SlitState::closed, SlitState::open};
  return kStates.at(table.choice("slits"));
}

geometry::NeckSlits read_slits(const StudyTable& table) {
  geometry::NeckSlits slits;
  slits.state = read_slit_state(table);
  if (table.has("slit_parts")) slits.parts = table.texts("slit_parts");
  if (table.choice("slit_edge") == 1) {
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
  return kKinds.at(table.choice("element"));
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

std::span<const Key> geometry_keys() {
  static const std::vector<std::string> meanings = [] {
    std::vector<std::string> all;
    for (const geometry::NeckDimension& dimension : geometry::neck_dimensions())
      all.push_back("Of the neck, which needs it: " + std::string(dimension.meaning));
    return all;
  }();
  static const std::vector<Key> keys = [] {
    std::vector<Key> all(kGeometryKeys.begin(), kGeometryKeys.end());
    for (std::size_t k = 0; k < meanings.size(); ++k)
      all.push_back(Key::quantity(geometry::neck_dimensions()[k].name, "m", kNone, meanings[k]));
    const std::span<const Key> others = structure_keys();
    all.insert(all.end(), others.begin(), others.end());
    return all;
  }();
  return keys;
}

std::span<const Key> mesh_keys() { return kMeshKeys; }

MaterialModels read_materials(const StudyTable& geometry, std::vector<mesher::Material>& materials,
                              std::map<std::string, std::string>& material_of_part) {
  MaterialModels models;
  const StudyTable table = geometry.table("materials");
  for (const std::string& name : table.keys()) {
    const StudyTable material = table.table(name);
    materials.push_back({name, material.quantity("youngs_modulus"),
                         material.number("poissons_ratio"), material.quantity("density")});
    MaterialModel& model = models[name];
    if (material.has("formulation")) model.formulation = read_formulation(material);
    model.static_modulus_ratio = material.number("static_modulus_ratio");
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
  const std::vector<std::string> faces = geometry.texts("slit_faces");
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
  section.script = geometry.file("script");
  section.neck = read_neck(geometry);
  section.slits = read_slits(geometry);
  const std::vector<double> point = geometry.quantities("joint_point");
  section.joint_point_m = Eigen::Map<const Eigen::Vector3d>(point.data());
  section.fitted_to = geometry.texts("fitted_to");
  section.material_models = read_materials(geometry, section.materials, section.material_of_part);
  if (!section.fitted_to.empty() && has_values_from_elsewhere(geometry)) section.fitted_to.clear();
  geometry.finish();
  section.divisions = read_divisions(mesh);
  section.element = read_element(mesh);
  mesh.finish();
  return section;
}

}  // namespace flexneck::pipeline
