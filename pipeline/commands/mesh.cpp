// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/neck_measures.h"
#include "mesher/script_mesher.h"
#include "pipeline/commands/commands.h"
#include "pipeline/commands/mesh_result.h"
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

ExactVolumes exact_volumes(const GeometrySection& geometry) {
  std::map<std::string, double> density_kg_m3;
  for (const auto& entry : geometry.material_of_part) {  // part and material
    const auto found = std::find_if(geometry.materials.begin(), geometry.materials.end(),
                                    [&](const auto& m) { return m.name == entry.second; });
    density_kg_m3[entry.first] = found->density_kg_m3;
  }
  ExactVolumes volumes;
  for (const auto& part : geometry::measure(geometry.neck, density_kg_m3).parts) {
    volumes[part.part] = part.volume_m3;
  }
  return volumes;
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
  file.provenance = mesh_provenance(input.study);
  finish_mesh(input, std::move(file), exact_volumes(geometry));
  return true;
}

}  // namespace flexneck::pipeline
