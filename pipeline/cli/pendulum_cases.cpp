// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/pendulum_cases.h"

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <utility>

#include "pipeline/cli/substructures.h"
#include "pipeline/process/customary_units.h"
#include "pipeline/process/result_files.h"
#include "pipeline/results/tables/csv_output.h"

namespace flexneck::pipeline {

std::vector<const CaseSection*> pendulum_cases(const Study& study) {
  std::vector<const CaseSection*> cases;
  for (const CaseSection& experiment : study.cases)
    if (experiment.kind == CaseSection::Kind::pendulum) cases.push_back(&experiment);
  return cases;
}

NeckModes read_neck_modes(const CommandInput& input) {
  const std::filesystem::path path = input.folder.modes();
  fe_modal::ModalBodyFile modes = read_modal_body(path);
  require_same_inputs(path, modes.provenance, input.study, modes_provenance(input.study).parameters,
                      "flexneck modes");
  std::vector<InputFile> files = {{path.filename().string(), hash_of_file(path.string())}};
  Study study = with_pieces(input, files);
  return {std::move(modes.body), std::move(files), std::move(study)};
}

PendulumCases::PendulumCases(const CommandInput& input, std::vector<const CaseSection*> cases)
    : input_(input), modes_(read_neck_modes(input)), cases_(std::move(cases)) {
  for (const CaseSection*& each : cases_)
    each = &modes_.study.cases[static_cast<std::size_t>(each - input.study.cases.data())];
}

void PendulumCases::compute_ahead() {
  const std::size_t ahead = threads_of(input_);
  while (running_.size() < ahead && written_ + running_.size() < cases_.size())
    running_.push_back(std::async(std::launch::async, run_pendulum, std::cref(modes_.study),
                                  std::cref(*cases_[written_ + running_.size()]),
                                  std::cref(modes_.body)));
}

void PendulumCases::write_next() {
  compute_ahead();
  if (running_.empty()) throw std::logic_error("every case of the pendulum has been written");
  const CaseSection& experiment = *cases_[written_];
  input_.console.step("Head/neck pendulum: " + experiment.name);
  PendulumRun run = running_.front().get();
  running_.pop_front();
  ++written_;
  write(experiment, std::move(run));
}

void PendulumCases::write(const CaseSection& experiment, PendulumRun&& run) {
  const ResultsFolder& folder = input_.folder;
  multibody::HistoryFile file;
  file.history = std::move(run.history);
  file.channels = std::move(run.channels);
  file.provenance = case_provenance(input_.study, experiment);
  file.provenance.inputs.insert(file.provenance.inputs.end(), modes_.files.begin(),
                                modes_.files.end());
  multibody::write_history(folder.history(experiment), file, [&] {
    write_csv(folder.curves(experiment), file.history.time_s, in_customary_units(file.channels));
  });
  for (const std::string& warning : file.history.warnings)
    input_.console.warning(experiment.name + ": " + warning);
  require_whole_run(folder.history(experiment), file.history);
  results_[experiment.name] =
      pendulum_result(input_.study, experiment, file.history.time_s, file.channels);
}

}  // namespace flexneck::pipeline
