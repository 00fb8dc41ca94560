// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/pendulum.h"

#include <algorithm>
#include <deque>
#include <future>
#include <thread>

#include "fe_modal/body/modal_body_file.h"
#include "multibody/history_file.h"
#include "pipeline/commands/commands.h"
#include "pipeline/experiments/pendulum_tables.h"
#include "pipeline/experiments/pulse_tables.h"
#include "pipeline/experiments/variant_tables.h"
#include "pipeline/output/csv_output.h"
#include "pipeline/output/customary_units.h"

namespace flexneck::pipeline {

namespace {

Provenance provenance_of_run(const CommandInput& input) {
  Provenance provenance = experiment_provenance(input.study, CaseSection::Kind::pendulum);
  provenance.inputs.push_back(
      {input.folder.modes().filename().string(), hash_of_file(input.folder.modes().string())});
  return provenance;
}

/// What a case gives, before anything is written.
struct Computed {
  PendulumRun run;
  PendulumEntry entry;
};

Computed compute(const Study& study, const CaseSection& experiment,
                 const fe_modal::ModalBody& body) {
  Computed computed;
  computed.run = run_pendulum(study, experiment, body);
  PendulumEntry& entry = computed.entry;
  entry.experiment = experiment;
  entry.pulse = case_pulse(study, experiment);
  entry.result =
      pendulum_result(study, experiment, computed.run.history.time_s, computed.run.channels);
  entry.hanging = first_system_mode(study, experiment, body, true);
  entry.weightless = first_system_mode(study, experiment, body, false);
  if (experiment.variant_of.empty() || !experiment.rigid_neck.empty())
    entry.cost = integration_cost(study, experiment, body);
  return computed;
}

void write(const CommandInput& input, const CaseSection& experiment, PendulumRun&& run,
           const Provenance& provenance) {
  write_csv(input.folder.curves(experiment), run.history.time_s, in_customary_units(run.channels));
  multibody::HistoryFile file;
  file.history = std::move(run.history);
  file.channels = std::move(run.channels);
  file.provenance = provenance;
  multibody::write_history(input.folder.history(experiment), file);
}

/// Computes cases on all processors and writes each as soon as it is its turn.
std::vector<PendulumEntry> run_cases(const CommandInput& input, const fe_modal::ModalBody& body,
                                     const Provenance& provenance) {
  std::vector<const CaseSection*> cases;
  for (const CaseSection& experiment : input.study.cases)
    if (experiment.kind == CaseSection::Kind::pendulum) cases.push_back(&experiment);
  const std::size_t ahead = std::max(1U, std::thread::hardware_concurrency());
  std::deque<std::future<Computed>> running;
  std::vector<PendulumEntry> entries;
  std::size_t next = 0;
  for (const CaseSection* const experiment : cases) {
    for (; next < cases.size() && running.size() < ahead; ++next)
      running.push_back(std::async(std::launch::async, compute, std::cref(input.study),
                                   std::cref(*cases[next]), std::cref(body)));
    input.console.step("Head/neck pendulum: " + experiment->name);
    Computed computed = running.front().get();
    running.pop_front();
    write(input, *experiment, std::move(computed.run), provenance);
    entries.push_back(std::move(computed.entry));
  }
  return entries;
}

void write_spectrum(const CommandInput& input) {
  constexpr Eigen::Index kLargest_Hz = 300;
  const Eigen::VectorXd frequencies_Hz =
      Eigen::VectorXd::LinSpaced(2 * kLargest_Hz + 1, 0, kLargest_Hz);
  write_csv(input.folder.file("pulse-spectrum.csv"), frequencies_Hz,
            spectrum_curves(input.study, frequencies_Hz), "frequency [Hz]");
}

/// What fits a console; pendulum.json has it all.
void print(const CommandInput& input, const std::vector<PendulumEntry>& entries,
           const std::vector<ResultTable>& variants, const std::vector<ResultTable>& measured) {
  std::vector<PendulumEntry> bases;
  for (const PendulumEntry& entry : entries)
    if (entry.experiment.variant_of.empty()) bases.push_back(entry);
  const auto show = [&](const ResultTable& table) { input.console.result("\n" + printed(table)); };
  show(peak_table(bases));
  show(oscillation_table(bases));
  show(velocity_table(entries));
  for (const ResultTable& table : variants) show(in_short(table));
  for (const ResultTable& table : measured) show(table);
  input.console.result("\nAll figures: " + input.folder.file("pendulum.json").string());
  for (const std::string& warning : pulse_warnings(entries)) input.console.step(warning);
}

}  // namespace

bool pendulum_command(const CommandInput& input) {
  const fe_modal::ModalBodyFile modes = fe_modal::read_modal_body(input.folder.modes());
  require_same_inputs(input.folder.modes(), modes.provenance, input.study, "flexneck modes");
  const Provenance provenance = provenance_of_run(input);
  const std::vector<PendulumEntry> entries = run_cases(input, modes.body, provenance);
  const std::vector<ResultTable> variants = variant_tables(entries);
  std::vector<ResultTable> tables = {peak_table(entries), oscillation_table(entries),
                                     velocity_table(entries),
                                     spectrum_table(input.study, entries, modes.body)};
  tables.insert(tables.end(), variants.begin(), variants.end());
  std::vector<ResultTable> measured;
  if (ResultTable necks = rigid_neck_table(input.study, modes.body); !necks.rows.empty()) {
    tables.push_back(std::move(necks));
    measured.push_back(processor_table(entries));
  }
  write_tables(input.folder.file("pendulum.json"), tables, provenance);
  // Apart from the others, which are the same bytes in every run.
  write_tables(input.folder.file("timing.json"), measured, provenance);
  write_spectrum(input);
  print(input, entries, variants, measured);
  return true;
}

}  // namespace flexneck::pipeline
