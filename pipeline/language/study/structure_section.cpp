// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/study/structure_section.h"

#include <algorithm>
#include <array>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/foundation/units.h"
#include "mesher/exchange/foreign_file.h"
#include "pipeline/language/document/table_values.h"
#include "pipeline/language/study/sections.h"

namespace flexneck::pipeline {

const std::filesystem::path& StructureSection::file() const {
  const auto* const script = std::get_if<mesher::ScriptMeshOptions>(&source);
  return script != nullptr ? script->script : std::get<mesher::ImportOptions>(source).file;
}

geometry::NeckMeasures measure_neck(const StructureSection& structure) {
  const auto& script = std::get<mesher::ScriptMeshOptions>(structure.source);
  std::map<std::string, double> density_kg_m3;
  for (const auto& [part, name] : script.material_of_part)
    for (const mesher::Material& material : script.materials)
      if (material.name == name) density_kg_m3[part] = material.density_kg_m3;
  return geometry::measure(structure.neck->dimensions, density_kg_m3);
}

namespace {

std::vector<std::string> coincident_nodes() { return {"refuse", "keep"}; }
std::vector<std::string> slit_states() { return {"none", "closed", "open"}; }
std::vector<std::string> node_orders() { return {"none", "nested-dissection"}; }
std::vector<std::string> elements() { return {"hex27", "hex20", "hex8", "tet10"}; }

constexpr Key kConstantKeys[] = {
    Key::number_or_quantity("*", "m", kNone,
                            "Value of the script's constant of this name: a number or a length"),
};

constexpr Key kSetKeys[] = {
    Key::text("name", kRequired, "Name of the face set and node set"),
    Key::quantities("from", "m", kRequired, "Corner of the box with the smallest coordinates",
                    {.size = 3}),
    Key::quantities("to", "m", kRequired, "Corner of the box with the largest coordinates",
                    {.size = 3}),
};

/// Keys of [geometry] besides those of the neck.
constexpr auto kKeys = std::to_array<Key>({
    Key::file("script", kNone, "gmsh script that defines and meshes the structure"),
    Key::file("file", kNone,
              "Instead of a script: a file with a mesh, or with a shape to be meshed"),
    Key::text("unit", "m", "Unit of length of the script or the file"),
    Key::text("force_unit", "N", "Unit of force of an .inp or .bdf file"),
    Key::table("constants", "Values for constants of the script", kConstantKeys),
    Key::text("slits", "none", "Slits: none, cut but tied shut, or open", {.choices = slit_states}),
    Key::texts("slit_faces", kNone, "Physical surfaces of the script on which the slits lie"),
    Key::text("coincident_nodes", "refuse",
              "Coincident nodes of a file: refuse the file, or keep them, as for a crack",
              {.choices = coincident_nodes}),
    Key::texts(
        "leave_out", kNone,
        "Unsupported cards of a .bdf file to ignore, although the structure changes without them"),
    Key::tables("set", "Face set and node set of the surface inside a box", kSetKeys),
});

constexpr auto kMeshKeys = std::to_array<Key>({
    Key::numbers("partitions", kNone,
                 "Numbers of processes for which a partition of the elements is stored",
                 {.changes_results = false}),
    Key::text("node_order", "none",
              "Elimination ordering of the nodes that is stored with the mesh",
              {.choices = node_orders, .changes_results = false}),
    Key::text("element", "hex27", "Element type of the mesh of a script", {.choices = elements}),
    Key::quantity("size", "m", "0", "Element size for STEP and BREP shapes; 0: chosen by gmsh",
                  {.range = at_least(0)}),
});

constexpr Key kMatricesKeys[] = {
    Key::file("stiffness", kRequired,
              "File with the stiffness matrix in N/m, without fixed degrees of freedom"),
    Key::file("mass", kRequired,
              "File with the mass matrix in kg, without fixed degrees of freedom"),
    Key::file("nodes", kRequired, "File with the positions of the nodes in m, one row per node"),
};

constexpr Key kInterfaceKeys[] = {
    Key::text("name", kRequired, "Name of the interface"),
    Key::text("set", kNone,
              "Face set, or fixed node set, of the interface (default: the set with the "
              "interface's name)"),
    Key::quantities("position", "m", kRequired, "Point at which other bodies are attached",
                    {.size = 3}),
};

/// Reads the constants of a script: pure numbers, or lengths, which are converted to its own unit.
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
        table.refuse("to", "expected coordinates that are not below those of from");
      }
    }
    table.finish();
  }
  return boxes;
}

mesher::ElementKind read_element(const StudyTable& table) {
  using mesher::ElementKind;
  constexpr std::array kKinds = {ElementKind::hex27, ElementKind::hex20, ElementKind::hex8,
                                 ElementKind::tet10};
  return kKinds.at(table.choice("element"));
}

/// Reads the slits of a script that does not draw the neck.
void read_slit_faces(const StudyTable& geometry, mesher::ScriptMeshOptions& options) {
  const geometry::SlitState state = read_slit_state(geometry);
  const std::vector<std::string> faces = geometry.texts("slit_faces");
  if (state == geometry::SlitState::none) {
    geometry.refuse_given({"slit_faces"}, "has no effect with slits = \"none\"");
    return;
  }
  if (faces.empty()) {
    geometry.refuse(
        "slit_faces",
        "expected the physical surfaces of the script on which the slits lie, found none");
  }
  options.slits = faces;
  options.slits_tied = state == geometry::SlitState::closed;
}

/// Reads a script; dimensions of the neck are constants of its script, in m.
mesher::ScriptMeshOptions read_script(const StudyTable& geometry, const StudyTable& mesh,
                                      std::optional<NeckSection>& neck) {
  mesher::ScriptMeshOptions options;
  options.script = geometry.file("script");
  if (has_neck(geometry)) {
    options.element = read_element(mesh);
    neck = read_neck(geometry, mesh);
    add_neck(*neck, options);
    return options;
  }
  options.length_unit_m = unit(geometry, "unit", "m");
  options.constants = read_constants(geometry.table("constants"), options.length_unit_m);
  if (mesh.has("element")) options.element = read_element(mesh);
  read_slit_faces(geometry, options);
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
    geometry.refuse("unit", "a STEP file contains its unit; remove this key");
  }
  options.length_unit_m = unit(geometry, "unit", "m");
  if (format == ForeignFormat::inp || format == ForeignFormat::bdf)
    options.force_unit_N = unit(geometry, "force_unit", "N");
  if (format == ForeignFormat::step || format == ForeignFormat::brep) {
    options.element_size_m = mesh.quantity("size");
    geometry.refuse_given({"coincident_nodes"},
                          "has no effect on a shape file, which has no nodes");
  }
  options.keeps_doubles = geometry.choice("coincident_nodes") == 1;
  options.leave_out = geometry.texts("leave_out");
  options.box_sets = read_box_sets(geometry);
  return options;
}

}  // namespace

std::span<const Key> geometry_keys() {
  static const std::vector<Key> keys = [] {
    std::vector<Key> all(kKeys.begin(), kKeys.end());
    all.push_back(Key::table("materials", "Materials of the parts", materials_keys()));
    all.insert(all.end(), neck_geometry_keys().begin(), neck_geometry_keys().end());
    return all;
  }();
  return keys;
}

std::span<const Key> mesh_keys() {
  static const std::vector<Key> keys = [] {
    std::vector<Key> all(kMeshKeys.begin(), kMeshKeys.end());
    all.insert(all.end(), neck_mesh_keys().begin(), neck_mesh_keys().end());
    return all;
  }();
  return keys;
}

std::span<const Key> matrices_keys() { return kMatricesKeys; }
std::span<const Key> interface_keys() { return kInterfaceKeys; }

geometry::SlitState read_slit_state(const StudyTable& table) {
  using geometry::SlitState;
  constexpr std::array kStates = {SlitState::none, SlitState::closed, SlitState::open};
  return kStates.at(table.choice("slits"));
}

StructureSection read_structure(const StudyTable& geometry, const StudyTable& mesh) {
  StructureSection section;
  if (geometry.has("file")) {
    if (geometry.has("script")) geometry.refuse("file", "expected file or script, found both");
    section.source = read_file(geometry, mesh);
  } else {
    section.source = read_script(geometry, mesh, section.neck);
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
