// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/pendulum.h"

#include "fe_modal/body/modal_body_file.h"
#include "multibody/history_file.h"
#include "pipeline/commands/commands.h"
#include "pipeline/experiments/pendulum_tables.h"
#include "pipeline/output/csv_output.h"
#include "pipeline/output/customary_units.h"

namespace flexneck::pipeline {

namespace {

Provenance provenance_of_run(const CommandInput& input) {
  Provenance provenance = provenance_of(input.study);
  provenance.inputs.push_back(
      {input.folder.modes().filename().string(), hash_of_file(input.folder.modes().string())});
  return provenance;
}

PendulumEntry run_case(const CommandInput& input, const CaseSection& experiment,
                       const fe_modal::ModalBody& body, const Provenance& provenance) {
  input.console.step("Head/neck pendulum: " + experiment.name);
  PendulumRun run = run_pendulum(input.study, experiment, body);
  PendulumEntry entry;
  entry.case_name = experiment.name;
  entry.result = pendulum_result(input.study, experiment, run.history.time_s, run.channels);
  entry.hanging = first_system_mode(input.study, experiment, body, true);
  entry.weightless = first_system_mode(input.study, experiment, body, false);
  write_csv(input.folder.curves(experiment), run.history.time_s, in_customary_units(run.channels));
  multibody::HistoryFile file;
  file.history = std::move(run.history);
  file.channels = std::move(run.channels);
  file.provenance = provenance;
  multibody::write_history(input.folder.history(experiment), file);
  return entry;
}

}  // namespace

bool pendulum_command(const CommandInput& input) {
  const fe_modal::ModalBodyFile modes = fe_modal::read_modal_body(input.folder.modes());
  require_same_inputs(input.folder.modes(), modes.provenance, input.study, "flexneck modes");
  const Provenance provenance = provenance_of_run(input);
  std::vector<PendulumEntry> entries;
  for (const CaseSection& experiment : input.study.cases) {
    if (experiment.kind != CaseSection::Kind::pendulum) continue;
    entries.push_back(run_case(input, experiment, modes.body, provenance));
  }
  const std::vector<ResultTable> tables = {peak_table(entries), oscillation_table(entries)};
  write_tables(input.folder.file("pendulum.json"), tables, provenance);
  for (const ResultTable& table : tables) input.console.result("\n" + printed(table));
  return true;
}

}  // namespace flexneck::pipeline
