// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/study/structure_section.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/units.h"
#include "mesher/exchange/foreign_file.h"
#include "pipeline/document/table_values.h"
#include "pipeline/study/sections.h"

namespace flexneck::pipeline {

const std::filesystem::path& StructureSection::file() const {
  const auto* const script = std::get_if<mesher::ScriptMeshOptions>(&source);
  return script != nullptr ? script->script : std::get<mesher::ImportOptions>(source).file;
}

namespace {

std::vector<std::string> coincident_nodes() { return {"refuse", "keep"}; }

constexpr Key kConstantKeys[] = {
    Key::number_or_quantity("*", "m", kNone, "A constant of the script, a number or a length"),
};

constexpr Key kSetKeys[] = {
    Key::text("name", kRequired, "Name of the face set and node set"),
    Key::quantities("from", "m", kRequired, "Corner of the box with the lowest coordinates",
                    {.size = 3}),
    Key::quantities("to", "m", kRequired, "Opposite corner", {.size = 3}),
};

constexpr Key kKeys[] = {
    Key::file("file", kNone, "In place of a script: a mesh or a shape to be meshed"),
    Key::text("unit", "m", "Length that the number 1 stands for in a script or a file"),
    Key::text("force_unit", "N", "Of an .inp: force that the number 1 stands for"),
    Key::table("constants", "Values of constants of the script", kConstantKeys),
    Key::text("coincident_nodes", "refuse",
              "Nodes of a file in the same place: a mistake, or meant, as at a crack",
              {.choices = coincident_nodes}),
    Key::tables("set", "A face set and node set of what lies in a box", kSetKeys),
};

constexpr Key kMatricesKeys[] = {
    Key::file("stiffness", kRequired, "Stiffness matrix in N/m, without directions that are fixed"),
    Key::file("mass", kRequired, "Mass matrix in kg, likewise"),
    Key::file("nodes", kRequired, "Positions of the nodes in m, a row each"),
};

constexpr Key kInterfaceKeys[] = {
    Key::text("name", kRequired, "Name of the interface"),
    Key::text(
        "set", kNone,
        "Face set, or fixed node set, that it stands for; the one of its name if the key is not "
        "there"),
    Key::quantities("position", "m", kRequired, "Point that other bodies attach to", {.size = 3}),
};

/// A constant of a script: a pure number, or a length, which the script gets in its own unit.
std::map<std::string, double> read_constants(const StudyTable& table, double length_unit_m) {
  std::map<std::string, double> constants;
  for (const std::string& key : table.keys()) {
    constants[key] = table.is_text(key) ? table.quantity(key) / length_unit_m : table.number(key);
  }
  table.finish();
  return constants;
}

double unit(const StudyTable& table, const std::string& key, const std::string& si_unit) {
  try {
    return parse_quantity("1 " + table.text(key), si_unit);
  } catch (const InputError& error) {
    table.refuse(key, error.what());
  }
}

std::array<double, 3> corner(const StudyTable& table, const std::string& key) {
  const std::vector<double> lengths = table.quantities(key);
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
  options.script = geometry.file("script");
  options.length_unit_m = unit(geometry, "unit", "m");
  options.constants = read_constants(geometry.table("constants"), options.length_unit_m);
  return options;
}

mesher::ImportOptions read_file(const StudyTable& geometry, const StudyTable& mesh) {
  using mesher::ForeignFormat;
  mesher::ImportOptions options;
  options.file = geometry.file("file");
  ForeignFormat format{};
  try {
    format = mesher::foreign_format_of(options.file);
  } catch (const InputError& error) {
    geometry.refuse("file", error.what());
  }
  if (format == ForeignFormat::step && geometry.has("unit")) {
    geometry.refuse("unit", "a STEP file says its unit itself; take this key away");
  }
  options.length_unit_m = unit(geometry, "unit", "m");
  if (format == ForeignFormat::inp) options.force_unit_N = unit(geometry, "force_unit", "N");
  if (format == ForeignFormat::step || format == ForeignFormat::brep) {
    options.element_size_m = mesh.quantity("size");
  }
  options.keeps_doubles = geometry.choice("coincident_nodes") == 1;
  options.box_sets = read_box_sets(geometry);
  return options;
}

}  // namespace

std::span<const Key> structure_keys() { return kKeys; }
std::span<const Key> matrices_keys() { return kMatricesKeys; }
std::span<const Key> interface_keys() { return kInterfaceKeys; }

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
  MatricesSection section{table.file("stiffness"), table.file("mass"), table.file("nodes")};
  table.finish();
  return section;
}

InterfaceSection read_interface(const StudyTable& table) {
  InterfaceSection interface { table.text("name"), {}, Eigen::Vector3d::Zero() };
  interface.set = table.text_or("set", interface.name);
  interface.position_m = quantity_vector(table, "position");
  table.finish();
  return interface;
}

}  // namespace flexneck::pipeline
