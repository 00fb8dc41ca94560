// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <functional>
#include <utility>

#include <fmt/core.h>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/algebra/ranks.h"
#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/body/modal_body_file.h"
#include "fe_modal/exchange/exported_matrices.h"
#include "fe_modal/exchange/modes_xdmf.h"
#include "fe_modal/system/memory_needs.h"
#include "fe_modal/system/modal_options_check.h"
#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/step_times.h"
#include "geometry/foundation/units.h"
#include "pipeline/cli/basis_text.h"
#include "pipeline/cli/commands.h"
#include "pipeline/cli/mode_table.h"
#include "pipeline/cli/sensitivity.h"
#include "pipeline/cli/stress.h"
#include "pipeline/cli/substructures.h"
#include "pipeline/parameter_studies/evaluation/modes_options.h"
#include "pipeline/parameter_studies/evaluation/structure_modes.h"
#include "pipeline/process/result_files.h"

namespace flexneck::pipeline {

namespace {

/// Runs `flexneck modes` for a study with [matrices].
/// @pre input.study.matrices
bool modes_of_matrices(const CommandInput& input) {
  const MatricesSection& files = *input.study.matrices;
  input.folder.make();
  input.console.step("Solving for " + std::to_string(input.study.modes.count) + " modes");
  const fe_modal::PetscSession session;
  const FilesRead reads;
  const fe_modal::ImportedBody matrices{fe_modal::read_matrix(files.stiffness),
                                        fe_modal::read_matrix(files.mass),
                                        fe_modal::read_positions(files.nodes)};
  fe_modal::ModalBodyFile file;
  file.body =
      fe_modal::analyse_matrices(matrices, options_of_solution(input.study), input.console.detail(),
                                 input.console.warnings("modes.h5"));
  file.provenance = provenance_of(input.study, {"matrices.", "modes."});
  const std::vector<InputFile> inputs = input_files(reads.files());
  file.provenance.inputs.insert(file.provenance.inputs.end(), inputs.begin(), inputs.end());
  file.provenance.libraries = fe_modal::library_versions();
  warn_of_replaced(input, input.folder.modes(), fe_modal::kModalBodyFormat, file.provenance);
  fe_modal::write_modal_body(input.folder.modes(), file);
  input.console.result(fmt::format(
      "\nModes: {}, {}; moving mass {:.4g} kg  ({})\nSolver: {}\n{}", file.body.boundary,
      file.body.completeness, file.body.invariants.mass, input.folder.modes().string(),
      file.body.solver, mode_table(file.body, input.console.is_verbose())));
  return true;
}

/// Mass as text: in pounds for the neck, as in its paper.
std::string mass_text(const Study& study, double mass_kg) {
  return study.neck() != nullptr ? fmt::format("{:.3f} lb", mass_kg * factor_from_si("kg", "lb"))
                                 : fmt::format("{:.4g} kg", mass_kg);
}

/// Reads the folder's mesh, the same on all ranks.
mesher::MeshFile read_mesh_together(const CommandInput& input) {
  const std::filesystem::path path = input.folder.mesh();
  if (!input.ranks.are_many()) return read_mesh(path);
  mesher::MeshFile mesh;
  input.ranks.together([&] { mesh = read_mesh(path); });
  const std::uint64_t hash = std::hash<std::string>()(hash_of_file(path.string()));
  const std::uint64_t of_first = input.ranks.of_first(hash);
  input.ranks.together([&] {
    if (hash != of_first)
      throw InputError(
          path.string() + ": rank " + std::to_string(input.ranks.own()) +
          " reads another file of this name than rank 0; use a folder that all ranks share");
  });
  return mesh;
}

/// Passes the partitions and the order of the mesh file to the analysis.
void share_work(const CommandInput& input, const mesher::MeshFile& mesh,
                fe_modal::ModalOptions& options) {
  options.ranks = input.ranks;
  options.node_order = mesh.node_order;
  const auto partition = mesh.partitions.find(input.ranks.count());
  if (partition != mesh.partitions.end()) options.element_ranks = partition->second;
}

Provenance provenance_of_modes(const CommandInput& input) {
  Provenance provenance = modes_provenance(input.study);
  provenance.inputs.push_back(
      {input.folder.mesh().filename().string(), hash_of_file(input.folder.mesh().string())});
  provenance.libraries = fe_modal::library_versions();
  return provenance;
}

/// Solves and writes the file of modes, and the view for ParaView.
fe_modal::ModalBody solve(const CommandInput& input, const mesher::Mesh& mesh,
                          const fe_modal::ModalOptions& options, const std::filesystem::path& path,
                          StepTimes& times, fe_modal::AnalysisFields* fields = nullptr) {
  fe_modal::ModalBodyFile file;
  file.body = fe_modal::analyse_modes(mesh, options, input.console.detail(), &times,
                                      input.console.warnings(path.filename().string()), fields);
  if (!writes(input)) return file.body;
  if (const std::string line = rounding_remark(mesh, options, file.body); !line.empty())
    input.console.warning(line);
  times.start("write");
  file.provenance = provenance_of_modes(input);
  warn_of_replaced(input, path, fe_modal::kModalBodyFormat, file.provenance);
  fe_modal::write_modal_body(path, file);
  fe_modal::write_modes_xdmf(path, input.folder.mesh(), mesh, file.body);
  times.stop();
  return file.body;
}

/// Solves for the modes that the static test needs, if a material has a separate static modulus.
void solve_static(const CommandInput& input, const mesher::Mesh& mesh,
                  fe_modal::ModalOptions options) {
  if (!input.study.has_static_moduli()) {
    if (writes(input)) std::filesystem::remove(input.folder.static_modes());
    return;
  }
  input.console.step("Solving again with the static moduli");
  options.check = false;
  StepTimes times;
  const fe_modal::ModalBody body =
      solve(input, with_static_moduli(mesh, input.study.material_models()), options,
            input.folder.static_modes(), times);
  input.console.result(fmt::format("\nModes with the static moduli: first {:.3f} Hz  ({})",
                                   body.frequencies_Hz[0], input.folder.static_modes().string()));
}

}  // namespace

bool modes_command(const CommandInput& input) {
  if (input.sensitivity) check_sensitivity(input.study);
  if (input.study.matrices) return !writes(input) || modes_of_matrices(input);
  StepTimes times;
  times.start("read");
  mesher::MeshFile mesh = read_mesh_together(input);
  require_same_inputs(input.folder.mesh(), mesh.provenance, input.study, mesh_values(input.study),
                      "flexneck mesh");
  if (!input.study.structure) {
    throw InputError(input.study.file.string() +
                     ": expected [geometry] for the interfaces, found none");
  }
  fe_modal::ModalOptions options = modes_options(input.study, mesh.mesh);
  share_work(input, mesh, options);
  fe_modal::check_options(mesh.mesh, options);
  for (const std::string& line : fe_modal::locking_warnings(mesh.mesh, options.formulation)) {
    input.console.warning(line);
  }
  const double dofs = 3.0 * static_cast<double>(mesh.mesh.nodes.size());
  const fe_modal::MemoryNeeds needs = fe_modal::memory_needs(dofs, options.mode_count);
  input.console.step(fmt::format("Solving for {} modes of {:.0f} degrees of freedom: about {}",
                                 options.mode_count, dofs, memory_text(needs.peak)));
  times.start("start PETSc");
  const fe_modal::PetscSession session;
  fe_modal::AnalysisFields fields;
  const fe_modal::ModalBody body = solve(input, mesh.mesh, options, input.folder.modes(), times,
                                         input.sensitivity ? &fields : nullptr);
  input.console.detail()("seconds: " + times.summary());
  const bool whole = input.console.is_verbose();
  input.console.result(fmt::format(
      "\nModes: {}, {}; mass {}  ({})\nSolver: {}\n{}{}", body.boundary, body.completeness,
      mass_text(input.study, body.invariants.mass), input.folder.modes().string(), body.solver,
      mode_table(body, whole), loaded_text(body, whole)));
  if (!body.prestress.empty()) input.console.result("Prestress: " + body.prestress);
  input.console.table(basis_text(body));
  // Removed, since the file would describe other modes.
  if (writes(input)) std::filesystem::remove(input.folder.sensitivities());
  if (input.sensitivity && writes(input))
    write_sensitivities(input, mesh.mesh, options, body, fields, provenance_of_modes(input));
  solve_static(input, mesh.mesh, options);
  write_substructures(input, mesh.mesh, options, provenance_of_modes(input));
  // The stresses have the same values, and PETSc starts once in a process. The first rank alone
  // computes them.
  if (input.is_run && writes(input) && !input.study.loads.empty())
    write_stresses(input, std::move(mesh));
  return true;
}

}  // namespace flexneck::pipeline
