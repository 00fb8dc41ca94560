// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/stress.h"

#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/analysis/estimate_limits.h"
#include "fe_modal/analysis/static_analysis.h"
#include "fe_modal/exchange/static_xdmf.h"
#include "geometry/foundation/error.h"
#include "pipeline/cli/stress_text.h"
#include "pipeline/parameter_studies/evaluation/modes_options.h"
#include "pipeline/process/result_files.h"

namespace flexneck::pipeline {

void write_stresses(const CommandInput& input, mesher::MeshFile mesh) {
  const Study& study = input.study;
  fe_modal::ModalOptions options = modes_options(study, mesh.mesh);
  options.node_order = mesh.node_order;
  options.prestress.clear();
  const auto warn_of = [&](const std::vector<std::string>& single) {
    for (const std::string& line : single)
      input.console.warning(
          line +
          " acts on single nodes, near which the results do not converge with mesh refinement");
  };
  warn_of(fe_modal::loaded_at_single_nodes(mesh.mesh, study.loads));
  warn_of(fe_modal::held_at_single_nodes(mesh.mesh, options));
  input.console.step(fmt::format("Static step with {} loads", study.loads.size()));
  fe_modal::StaticSolutionFile file;
  try {
    file.solution =
        fe_modal::analyse_static(mesh.mesh, options, study.loads, input.console.detail());
  } catch (const InputError& error) {
    throw InputError(study.file.string() + ": " + error.what());
  }
  file.provenance = modes_provenance(study);
  file.provenance.inputs.push_back(
      {input.folder.mesh().filename().string(), hash_of_file(input.folder.mesh().string())});
  file.provenance.libraries = fe_modal::library_versions();
  const std::filesystem::path path = input.folder.stress();
  warn_of_replaced(input, path, fe_modal::kStaticSolutionFormat, file.provenance);
  fe_modal::write_static_solution(path, file);
  fe_modal::write_static_xdmf(path, input.folder.mesh(), mesh.mesh, file.solution);
  input.console.result(fmt::format("\nStatic step: {}  ({})\n{}", file.solution.boundary,
                                   path.string(), stress_text(file.solution)));
}

bool stress_command(const CommandInput& input) {
  const Study& study = input.study;
  if (study.loads.empty())
    throw InputError(study.file.string() + ": expected a [[load]] for the static step, found none");
  mesher::MeshFile mesh = read_mesh(input.folder.mesh());
  require_same_inputs(input.folder.mesh(), mesh.provenance, study, mesh_values(study),
                      "flexneck mesh");
  for (const std::string& line : fe_modal::locking_warnings(mesh.mesh, formulation_of(study)))
    input.console.warning(line);
  const fe_modal::PetscSession session;
  write_stresses(input, std::move(mesh));
  return true;
}

}  // namespace flexneck::pipeline
