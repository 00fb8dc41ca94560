// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/study/sections.h"

namespace flexneck::pipeline {

namespace {

geometry::NeckParameters read_neck(const StudyTable& table) {
  const auto length = [&](const std::string& key) { return table.quantity(key, "m"); };
  geometry::NeckParameters neck;
  neck.length = length("length");
  neck.base_plate_thickness = length("base_plate_thickness");
  neck.plate_thickness = length("plate_thickness");
  neck.top_plate_thickness = length("top_plate_thickness");
  neck.plate_diameter = length("plate_diameter");
  neck.hole_diameter = length("hole_diameter");
  neck.centre_rubber_diameter = length("centre_rubber_diameter");
  neck.centre_rubber_offset = length("centre_rubber_offset");
  neck.bottom_rubber_diameter = length("bottom_rubber_diameter");
  neck.bottom_rubber_offset = length("bottom_rubber_offset");
  neck.top_rubber_diameter = length("top_rubber_diameter");
  neck.top_rubber_offset = length("top_rubber_offset");
  neck.bolt_circle_radius = length("bolt_circle_radius");
  neck.bolt_patch_radius = length("bolt_patch_radius");
  return neck;
}

void read_materials(const StudyTable& table, GeometrySection& section) {
  const StudyTable materials = table.table("materials");
  for (const std::string& name : materials.keys()) {
    const StudyTable material = materials.table(name);
    section.materials.push_back({name, material.quantity("youngs_modulus", "Pa"),
                                 material.number("poissons_ratio"),
                                 material.quantity("density", "kg/m^3")});
    for (const std::string& part : material.texts("parts")) {
      if (!section.material_of_part.emplace(part, name).second) {
        material.refuse("parts", "the part '" + part + "' has another material already");
      }
    }
    material.finish();
  }
}

geometry::NeckDivisions read_divisions(const StudyTable& table) {
  geometry::NeckDivisions divisions;
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
  return divisions;
}

}  // namespace

GeometrySection read_geometry(const StudyTable& geometry, const StudyTable& mesh) {
  GeometrySection section;
  section.script = geometry.folder_of("script") / geometry.text("script");
  section.neck = read_neck(geometry);
  const std::vector<double> point = geometry.quantities("joint_point", "m", 3);
  section.joint_point_m = Eigen::Map<const Eigen::Vector3d>(point.data());
  if (geometry.has("fitted_to")) section.fitted_to = geometry.texts("fitted_to");
  read_materials(geometry, section);
  geometry.finish();
  section.divisions = read_divisions(mesh);
  mesh.finish();
  return section;
}

}  // namespace flexneck::pipeline
