// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/commands/mesh_structure.h"

#include <utility>

#include "geometry/foundation/error.h"
#include "mesher/exchange/import_check.h"
#include "mesher/exchange/mesh_import.h"
#include "pipeline/commands/mesh_result.h"

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

}  // namespace

bool mesh_structure(const CommandInput& input) {
  const StructureSection& structure = *input.study.structure;
  input.folder.make();
  input.console.step("Meshing " + structure.file().filename().string());
  mesher::MeshFile file;
  file.mesh = make_mesh(structure, input.console.detail());
  file.provenance = mesh_provenance(input.study);
  finish_mesh(input, std::move(file), {});
  return true;
}

}  // namespace flexneck::pipeline
