// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "geometry/foundation/error.h"
#include "geometry/neck_measures.h"
#include "pipeline/commands/commands.h"
#include "pipeline/commands/make_mesh.h"
#include "pipeline/commands/mesh_result.h"

namespace flexneck::pipeline {

namespace {

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
  const Study& study = input.study;
  if (!study.geometry && !study.structure) {
    throw InputError(study.file.string() + ": there is no [geometry], so nothing to mesh");
  }
  input.folder.make();
  const std::filesystem::path& source =
      study.structure ? study.structure->file() : study.geometry->script;
  input.console.step("Meshing " + source.filename().string());
  mesher::MeshFile file;
  file.mesh = make_mesh(study, input.console);
  file.provenance = mesh_provenance(study);
  finish_mesh(input, std::move(file),
              study.geometry ? exact_volumes(*study.geometry) : ExactVolumes());
  return true;
}

}  // namespace flexneck::pipeline
