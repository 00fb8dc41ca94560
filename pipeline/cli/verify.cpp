// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/foundation/error.h"
#include "pipeline/cli/commands.h"
#include "pipeline/cli/shown_tables.h"
#include "pipeline/cli/substructures.h"
#include "pipeline/cli/verdicts.h"
#include "pipeline/experiments/verification/verification.h"
#include "pipeline/process/result_files.h"

namespace flexneck::pipeline {

namespace {

/// Evidence of a case: linearised motions are computed here; a run is read if it exists.
PendulumEvidence evidence_of(const CommandInput& input, const Study& study,
                             const CaseSection& experiment, const fe_modal::ModalBody& body) {
  PendulumEvidence evidence;
  evidence.case_name = experiment.name;
  const bool lateral = experiment.direction == CaseSection::Direction::lateral;
  evidence.plane = lateral ? "lateral" : "fore-aft";
  evidence.with_gravity = first_system_mode(study, experiment, body, true);
  evidence.without_gravity = first_system_mode(study, experiment, body, false);
  const std::filesystem::path path = input.folder.history(experiment);
  if (!std::filesystem::exists(path)) return evidence;
  const multibody::HistoryFile file = read_history(path);
  require_same_inputs(path, file.provenance, study, case_provenance(study, experiment).parameters,
                      "flexneck pendulum");
  require_whole_run(path, file.history);
  evidence.run = pendulum_result(study, experiment, file.history.time_s, file.channels);
  return evidence;
}

/// Compares the computed results with the published ones.
/// @return true if all judged figures agree
bool compare_with_published(const CommandInput& input) {
  const FilesRead reads;
  const Reference reference = read_reference(input.study.verification);
  const std::vector<InputFile> published = input_files(reads.files());
  const fe_modal::ModalBodyFile modes = read_modal_body(input.folder.modes());
  require_same_inputs(input.folder.modes(), modes.provenance, input.study,
                      modes_provenance(input.study).parameters, "flexneck modes");
  if (!modes.body.prestress.empty())
    throw InputError(input.folder.modes().string() +
                     ": published figures apply to bodies without prestress; make the modes "
                     "without modes.prestress");
  Provenance provenance = provenance_of(input.study);
  const Study study = with_pieces(input, provenance.inputs);
  std::vector<PendulumEvidence> pendulum;
  for (const CaseSection& experiment : study.cases) {
    if (experiment.kind != CaseSection::Kind::pendulum || !experiment.variant_of.empty()) continue;
    // No values are published for this direction.
    if (experiment.direction == CaseSection::Direction::oblique) continue;
    pendulum.push_back(evidence_of(input, study, experiment, modes.body));
  }
  const VerificationTable table = verify(input.study, modes.body, pendulum, reference);

  provenance.inputs.insert(provenance.inputs.end(), published.begin(), published.end());
  provenance.inputs.push_back(
      {input.folder.modes().filename().string(), hash_of_file(input.folder.modes().string())});
  write_verification(input.folder.verification(), table, provenance);
  input.console.result("\nVerification against " + table.reference_origins + " figures  (" +
                       input.folder.verification().string() + ")");
  show_verification(input, table);
  return table.passed();
}

}  // namespace

bool verify_command(const CommandInput& input) {
  const Study& study = input.study;
  if (study.verification.empty() && !has_tests(study)) {
    throw InputError(study.file.string() +
                     ": expected output.verification with a file of published figures, or a "
                     "[[test]], found neither");
  }
  const bool passed = study.verification.empty() || compare_with_published(input);
  // A neck that fails a certification is a result of the study, not an error of the program.
  if (has_tests(study)) write_verdicts(input);
  return passed;
}

}  // namespace flexneck::pipeline
