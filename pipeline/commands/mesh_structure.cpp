// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/commands/mesh_structure.h"

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/plausibility.h"
#include "mesher/exchange/bounding_box.h"
#include "mesher/exchange/import_check.h"
#include "mesher/exchange/mesh_import.h"
#include "mesher/exchange/xdmf_writer.h"
#include "mesher/mesh/mesh_file.h"
#include "mesher/mesh/mesh_summary.h"
#include "pipeline/text_table.h"

namespace flexneck::pipeline {

namespace {

mesher::Mesh make_mesh(const StructureSection& structure, const Progress& progress) {
  if (const auto* const script = std::get_if<mesher::ScriptMeshOptions>(&structure.source)) {
    mesher::Mesh mesh = mesher::mesh_script(*script, progress);
    try {  // a script may leave bodies apart, or lay them over one another
      mesher::check_import(mesh, !script->slits.empty());
    } catch (const InputError& error) {
      throw InputError(script->script.string() + ": " + error.what());
    }
    return mesh;
  }
  return mesher::import_mesh(std::get<mesher::ImportOptions>(structure.source), progress);
}

std::string part_table(const mesher::MeshSummary& summary) {
  std::vector<std::vector<std::string>> rows = {
      {"part", "element", "material", "elements", "volume m^3", "mass kg", "scaled Jacobian"}};
  for (const mesher::PartSummary& part : summary.parts) {
    rows.push_back({part.part, std::string(name_of(part.kind)), part.material,
                    std::to_string(part.elements), fmt::format("{:.4g}", part.volume_m3),
                    fmt::format("{:.4g}", part.mass_kg),
                    fmt::format("{:.3f}", part.smallest_scaled_jacobian)});
  }
  return text_table(rows, {0, 1, 2});
}

}  // namespace

bool mesh_structure(const CommandInput& input) {
  const StructureSection& structure = *input.study.structure;
  const std::filesystem::path& source = structure.file();
  input.folder.make();
  input.console.step("Meshing " + source.filename().string());
  mesher::MeshFile file;
  file.mesh = make_mesh(structure, input.console.detail());
  file.provenance = provenance_of(input.study, {"geometry.", "mesh."});
  file.provenance.inputs.push_back({source.filename().string(), hash_of_file(source.string())});
  file.provenance.libraries["gmsh"] = mesher::gmsh_version();
  mesher::write_mesh(input.folder.mesh(), file);
  mesher::write_xdmf(input.folder.mesh(), file);

  const mesher::MeshSummary summary = mesher::summarise(file.mesh);
  const Eigen::Vector3d extent = mesher::bounding_box(file.mesh).extent_m();
  input.console.result(
      fmt::format("\nMesh: {} elements, {} nodes, {:.4g} x {:.4g} x {:.4g} m, {:.4g} kg  ({})\n{}",
                  summary.elements, summary.nodes, extent[0], extent[1], extent[2], summary.mass_kg,
                  input.folder.mesh().string(), part_table(summary)));
  for (const std::string& remark : geometry::implausibilities(extent.maxCoeff(), summary.mass_kg)) {
    input.console.step("Warning: " + remark);
  }
  return true;
}

}  // namespace flexneck::pipeline
