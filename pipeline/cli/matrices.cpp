// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/matrices.h"

#include <fmt/core.h>

#include "fe_modal/algebra/petsc_session.h"
#include "fe_modal/analysis/modal_analysis.h"
#include "fe_modal/body/modal_body_file.h"
#include "fe_modal/exchange/exported_matrices.h"
#include "geometry/foundation/error.h"
#include "pipeline/cli/mode_table.h"
#include "pipeline/parameter_studies/evaluation/modes_options.h"

namespace flexneck::pipeline {

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

}  // namespace flexneck::pipeline
