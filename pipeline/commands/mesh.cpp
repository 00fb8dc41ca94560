// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/core.h>

#include "geometry/foundation/error.h"
#include "geometry/plausibility.h"
#include "mesher/exchange/xdmf_writer.h"
#include "mesher/mesh/mesh_file.h"
#include "mesher/mesh/mesh_summary.h"
#include "mesher/script_mesher.h"
#include "pipeline/commands/commands.h"
#include "pipeline/commands/mesh_structure.h"

namespace flexneck::pipeline {

namespace {

mesher::ScriptMeshOptions mesh_options(const GeometrySection& geometry) {
  mesher::ScriptMeshOptions options;
  options.script = geometry.script;
  options.constants = geometry::script_constants(geometry.neck, geometry.divisions);
  options.materials = geometry.materials;
  options.constants.merge(geometry::script_constants(geometry.slits));
  if (geometry.element == mesher::ElementKind::tet10) options.constants["recombine"] = 0;
  options.element = geometry.element;
  options.slits = geometry::slit_face_sets(geometry.slits);
  options.slits_tied = geometry.slits.state == geometry::SlitState::closed;
  options.material_of_part = geometry.material_of_part;
  const auto centres = geometry::bolt_centres(geometry.neck);
  options.patches = {
      {"bolts", "base", {centres.begin(), centres.end()}, geometry.neck.bolt_patch_radius}};
  return options;
}

void warn_if_implausible(const geometry::NeckParameters& neck, double mass_kg,
                         const Console& console) {
  const double extent_m = std::max(neck.length, neck.plate_diameter);
  for (const std::string& remark : geometry::implausibilities(extent_m, mass_kg)) {
    console.step("Warning: " + remark);
  }
}

}  // namespace

bool mesh_command(const CommandInput& input) {
  if (input.study.structure) return mesh_structure(input);
  if (!input.study.geometry) {
    throw InputError(input.study.file.string() + ": there is no [geometry], so nothing to mesh");
  }
  const GeometrySection& geometry = *input.study.geometry;
  input.folder.make();
  input.console.step("Meshing " + geometry.script.filename().string());
  mesher::MeshFile file;
  file.mesh = mesher::mesh_script(mesh_options(geometry), input.console.detail());
  file.provenance = provenance_of(input.study, {"geometry.", "mesh."});
  file.provenance.inputs.push_back(
      {geometry.script.filename().string(), hash_of_file(geometry.script.string())});
  file.provenance.libraries["gmsh"] = mesher::gmsh_version();
  mesher::write_mesh(input.folder.mesh(), file);
  mesher::write_xdmf(input.folder.mesh(), file);
  warn_if_implausible(geometry.neck, mesher::summarise(file.mesh).mass_kg, input.console);

  std::size_t elements = 0;
  for (const mesher::ElementBlock& block : file.mesh.blocks) elements += block.size();
  input.console.result(fmt::format("\nMesh: {} elements, {} nodes  ({})", elements,
                                   file.mesh.nodes.size(), input.folder.mesh().string()));
  return true;
}

}  // namespace flexneck::pipeline
