// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/commands/mesh_structure.h"

#include <algorithm>

#include <Eigen/Core>
#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "mesher/exchange/mesh_import.h"
#include "mesher/exchange/xdmf_writer.h"
#include "mesher/mesh/mesh_file.h"
#include "mesher/mesh/mesh_summary.h"
#include "pipeline/text_table.h"

namespace flexneck::pipeline {

namespace {

mesher::Mesh make_mesh(const StructureSection& structure, const Progress& progress) {
  if (const auto* const script = std::get_if<mesher::ScriptMeshOptions>(&structure.source)) {
    return mesher::mesh_script(*script, progress);
  }
  return mesher::import_mesh(std::get<mesher::ImportOptions>(structure.source), progress);
}

Eigen::Vector3d extent_m(const mesher::Mesh& mesh) {
  Eigen::Vector3d low(mesh.nodes.front().data());
  Eigen::Vector3d high = low;
  for (const auto& node : mesh.nodes) {
    low = low.cwiseMin(Eigen::Vector3d(node.data()));
    high = high.cwiseMax(Eigen::Vector3d(node.data()));
  }
  return high - low;
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

/// Parts of seats, dummies and test rigs lie between a millimetre and ten metres, and weigh less
/// than ten tonnes. What lies outside was most likely declared in the wrong unit.
void warn_if_implausible(const mesher::MeshSummary& summary, double largest_m,
                         const Console& console) {
  constexpr double kSmall_m = 1e-3;
  constexpr double kLarge_m = 10;
  constexpr double kHeavy_kg = 1e4;
  if (largest_m > kSmall_m && largest_m < kLarge_m && summary.mass_kg < kHeavy_kg) return;
  console.step(
      fmt::format("Warning: the structure is {:.3g} m long and weighs {:.3g} kg; is geometry.unit "
                  "what the file counts in?",
                  largest_m, summary.mass_kg));
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
  const Eigen::Vector3d extent = extent_m(file.mesh);
  input.console.result(
      fmt::format("\nMesh: {} elements, {} nodes, {:.4g} x {:.4g} x {:.4g} m, {:.4g} kg  ({})\n{}",
                  summary.elements, summary.nodes, extent[0], extent[1], extent[2], summary.mass_kg,
                  input.folder.mesh().string(), part_table(summary)));
  warn_if_implausible(summary, extent.maxCoeff(), input.console);
  return true;
}

}  // namespace flexneck::pipeline
