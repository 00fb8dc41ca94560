// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/study/structure_section.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/units.h"
#include "mesher/exchange/foreign_file.h"
#include "pipeline/study/sections.h"

namespace flexneck::pipeline {

const std::filesystem::path& StructureSection::file() const {
  const auto* const script = std::get_if<mesher::ScriptMeshOptions>(&source);
  return script != nullptr ? script->script : std::get<mesher::ImportOptions>(source).file;
}

namespace {

/// A constant of a script: a pure number, or a length, which the script gets in its own unit.
std::map<std::string, double> read_constants(const StudyTable& table, double length_unit_m) {
  std::map<std::string, double> constants;
  for (const std::string& key : table.keys()) {
    constants[key] =
        table.is_text(key) ? table.quantity(key, "m") / length_unit_m : table.number(key);
  }
  table.finish();
  return constants;
}

double unit_or(const StudyTable& table, const std::string& key, const std::string& fallback) {
  const std::string unit = table.text_or(key, fallback);
  try {
    return parse_quantity("1 " + unit, fallback);
  } catch (const InputError& error) {
    table.refuse(key, error.what());
  }
}

std::array<double, 3> corner(const StudyTable& table, const std::string& key) {
  const std::vector<double> lengths = table.quantities(key, "m", 3);
  return {lengths[0], lengths[1], lengths[2]};
}

std::vector<mesher::BoxSet> read_box_sets(const StudyTable& geometry) {
  std::vector<mesher::BoxSet> boxes;
  for (const StudyTable& table : geometry.tables("set")) {
    boxes.push_back({table.text("name"), corner(table, "from"), corner(table, "to")});
    for (std::size_t d = 0; d < 3; ++d) {
      if (boxes.back().low_m[d] > boxes.back().high_m[d]) {
        table.refuse("to", "expected no coordinate below that of from");
      }
    }
    table.finish();
  }
  return boxes;
}

mesher::ScriptMeshOptions read_script(const StudyTable& geometry) {
  mesher::ScriptMeshOptions options;
  options.script = geometry.folder_of("script") / geometry.text("script");
  options.length_unit_m = unit_or(geometry, "unit", "m");
  options.constants = read_constants(geometry.table("constants"), options.length_unit_m);
  return options;
}

mesher::ImportOptions read_file(const StudyTable& geometry, const StudyTable& mesh) {
  using mesher::ForeignFormat;
  mesher::ImportOptions options;
  options.file = geometry.folder_of("file") / geometry.text("file");
  ForeignFormat format{};
  try {
    format = mesher::foreign_format_of(options.file);
  } catch (const InputError& error) {
    geometry.refuse("file", error.what());
  }
  if (format == ForeignFormat::step && geometry.has("unit")) {
    geometry.refuse("unit", "a STEP file says its unit itself; take this key away");
  }
  options.length_unit_m = unit_or(geometry, "unit", "m");
  if (format == ForeignFormat::inp) options.force_unit_N = unit_or(geometry, "force_unit", "N");
  if (format == ForeignFormat::step || format == ForeignFormat::brep) {
    options.element_size_m = mesh.quantity_or("size", "m", 0);
  }
  const std::string doubles = geometry.text_or("coincident_nodes", "refuse");
  if (doubles != "refuse" && doubles != "keep") {
    geometry.refuse("coincident_nodes",
                    "expected \"refuse\" or \"keep\", found \"" + doubles + "\"");
  }
  options.keeps_doubles = doubles == "keep";
  options.box_sets = read_box_sets(geometry);
  return options;
}

}  // namespace

bool is_structure(const StudyTable& geometry) {
  if (geometry.has("file")) return true;
  constexpr std::array<const char*, 4> kOfTheNeck = {"length", "plate_diameter", "hole_diameter",
                                                     "plate_thickness"};
  return geometry.has("script") && std::none_of(kOfTheNeck.begin(), kOfTheNeck.end(),
                                                [&](const char* key) { return geometry.has(key); });
}

StructureSection read_structure(const StudyTable& geometry, const StudyTable& mesh) {
  StructureSection section;
  if (geometry.has("file")) {
    if (geometry.has("script")) geometry.refuse("file", "expected file or script, found both");
    section.source = read_file(geometry, mesh);
  } else {
    mesher::ScriptMeshOptions options = read_script(geometry);
    read_script_options(geometry, mesh, options);
    section.source = std::move(options);
  }
  std::visit(
      [&](auto& options) {
        section.material_models =
            read_materials(geometry, options.materials, options.material_of_part);
      },
      section.source);
  geometry.finish();
  mesh.finish();
  return section;
}

MatricesSection read_matrices(const StudyTable& table) {
  const auto file = [&](const std::string& key) { return table.folder_of(key) / table.text(key); };
  MatricesSection section{file("stiffness"), file("mass"), file("nodes")};
  table.finish();
  return section;
}

InterfaceSection read_interface(const StudyTable& table) {
  InterfaceSection interface { table.text("name"), {}, Eigen::Vector3d::Zero() };
  interface.set = table.text_or("set", interface.name);
  const std::vector<double> position = table.quantities("position", "m", 3);
  interface.position_m = Eigen::Map<const Eigen::Vector3d>(position.data());
  table.finish();
  return interface;
}

}  // namespace flexneck::pipeline
