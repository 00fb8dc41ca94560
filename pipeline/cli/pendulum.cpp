// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/pendulum.h"

#include "pipeline/cli/commands.h"
#include "pipeline/cli/pendulum_cases.h"
#include "pipeline/cli/shown_tables.h"
#include "pipeline/experiments/pendulum_tables.h"
#include "pipeline/experiments/pulse_tables.h"
#include "pipeline/experiments/relaxation_table.h"
#include "pipeline/experiments/rigid_neck.h"
#include "pipeline/experiments/section_table.h"
#include "pipeline/experiments/variant_tables.h"
#include "pipeline/process/result_files.h"
#include "pipeline/process/wrapped_text.h"
#include "pipeline/results/tables/csv_output.h"

namespace flexneck::pipeline {

namespace {

PendulumResult result_from_file(const CommandInput& input, const CaseSection& experiment) {
  const Study& study = input.study;
  const std::filesystem::path path = input.folder.history(experiment);
  const multibody::HistoryFile file = read_history(path);
  require_same_inputs(path, file.provenance, study, case_provenance(study, experiment).parameters,
                      "flexneck pendulum");
  require_whole_run(path, file.history);
  return pendulum_result(study, experiment, file.history.time_s, file.channels);
}

/// The figures from a case's run, and those that need no run.
PendulumEntry entry_of(const CommandInput& input, const CaseSection& experiment,
                       const PendulumResults& known, const NeckModes& modes) {
  const Study& study = modes.study;
  const fe_modal::ModalBody& body = modes.body;
  PendulumEntry entry;
  entry.experiment = experiment;
  entry.pulse = case_pulse(study, experiment);
  const auto run = known.find(experiment.name);
  entry.result = run != known.end() ? run->second : result_from_file(input, experiment);
  entry.hanging = first_system_mode(study, experiment, body, true);
  entry.weightless = first_system_mode(study, experiment, body, false);
  if (experiment.variant_of.empty() || has_rigid_neck(experiment))
    entry.cost = integration_cost(study, experiment, body);
  return entry;
}

void write_spectrum(const CommandInput& input) {
  constexpr Eigen::Index kLargest_Hz = 300;
  const Eigen::VectorXd frequencies_Hz =
      Eigen::VectorXd::LinSpaced(2 * kLargest_Hz + 1, 0, kLargest_Hz);
  write_csv(input.folder.file("pulse-spectrum.csv"), frequencies_Hz,
            spectrum_curves(input.study, frequencies_Hz), "frequency [Hz]");
}

}  // namespace

bool pendulum_command(const CommandInput& input) {
  const std::vector<const CaseSection*> all = pendulum_cases(input.study);
  PendulumCases cases(input, all);
  for (std::size_t k = 0; k < all.size(); ++k) cases.write_next();
  write_pendulum_tables(input, cases.results());
  return true;
}

void write_pendulum_tables(const CommandInput& input, const PendulumResults& known) {
  const NeckModes modes = read_neck_modes(input);
  std::vector<PendulumEntry> entries;
  for (const CaseSection* const experiment : pendulum_cases(modes.study))
    entries.push_back(entry_of(input, *experiment, known, modes));
  const std::vector<ResultTable> variants = variant_tables(modes.study, entries);
  std::vector<ResultTable> tables = {peak_table(modes.study, entries), oscillation_table(entries),
                                     velocity_table(entries),
                                     spectrum_table(modes.study, entries, modes.body)};
  tables.insert(tables.end(), variants.begin(), variants.end());
  if (ResultTable sections = section_table(modes.study); !sections.rows.empty())
    tables.push_back(std::move(sections));
  if (ResultTable relaxation = relaxation_table(modes.study); !relaxation.rows.empty())
    tables.push_back(std::move(relaxation));
  std::vector<ResultTable> measured;
  if (ResultTable necks = rigid_neck_table(modes.study, modes.body); !necks.rows.empty()) {
    tables.push_back(std::move(necks));
    measured.push_back(processor_table(entries));
  }
  Provenance provenance = experiment_provenance(input.study, CaseSection::Kind::pendulum);
  provenance.inputs.insert(provenance.inputs.end(), modes.files.begin(), modes.files.end());
  write_tables(input.folder.file("pendulum.json"), tables, provenance);
  // Timings are in a file of their own, since the other files have the same bytes in every run.
  write_tables(input.folder.file("timing.json"), measured, provenance);
  write_spectrum(input);
  tables.insert(tables.end(), measured.begin(), measured.end());
  show_tables(input, tables);
  input.console.result("\nAll figures: " + input.folder.file("pendulum.json").string());
  for (const std::string& line : scaling_lines(entries)) {
    std::string text = wrapped(line, "");
    text.pop_back();
    input.console.result(text);
  }
  for (const std::string& warning : pulse_warnings(entries)) input.console.warning(warning);
}

}  // namespace flexneck::pipeline
