// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/error.h"
#include "mesher/exchange/inp_writer.h"
#include "mesher/exchange/msh_writer.h"
#include "mesher/mesh/mesh_file.h"
#include "pipeline/commands/commands.h"

namespace flexneck::pipeline {

namespace {

/// The neck stands on its bolts unless the study says otherwise.
std::vector<std::string> held_sets(const Study& study) {
  if (study.modes.held.empty() && study.geometry) return {"bolts"};
  return study.modes.held;
}

}  // namespace

bool export_command(const CommandInput& input) {
  const std::filesystem::path& target = input.target;
  if (target.empty()) {
    throw InputError("export: name the file to write, --to FILE.msh or --to FILE.inp");
  }
  const mesher::MeshFile mesh = mesher::read_mesh(input.folder.mesh());
  require_same_inputs(input.folder.mesh(), mesh.provenance, input.study, "flexneck mesh");
  input.console.step("Writing " + target.string());
  try {
    if (target.extension() == ".msh") {
      mesher::write_msh(target, mesh.mesh,
                        input.is_binary ? mesher::MshEncoding::binary : mesher::MshEncoding::text);
    } else if (target.extension() == ".inp") {
      const bool is_reduced = input.study.modes.formulation == fe_modal::Formulation::reduced;
      mesher::write_inp(target, mesh.mesh,
                        {is_reduced, held_sets(input.study), input.study.modes.count});
    } else {
      throw InputError("expected a file with the ending .msh or .inp");
    }
  } catch (const InputError& error) {
    throw InputError(target.string() + ": " + error.what());
  }
  return true;
}

}  // namespace flexneck::pipeline
