// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>

#include "geometry/foundation/error.h"
#include "multibody/history/incomplete_run.h"
#include "pipeline/cli/commands.h"
#include "pipeline/cli/shown_tables.h"
#include "pipeline/cli/substructures.h"
#include "pipeline/experiments/case_model.h"
#include "pipeline/experiments/static_chain.h"
#include "pipeline/experiments/static_tables.h"
#include "pipeline/experiments/static_test.h"
#include "pipeline/parameter_studies/evaluation/pieces_of_cases.h"
#include "pipeline/process/customary_units.h"
#include "pipeline/process/result_files.h"
#include "pipeline/results/tables/csv_output.h"

namespace flexneck::pipeline {

namespace {

namespace fs = std::filesystem;

/// Reads the neck's submeshes from their files, to compare their chain with the neck; none if the
/// study defines none, if a test has them as sections already, if slits are kept shut only by
/// sections, or if the tests have moduli of their own, with which the submeshes were not made.
std::vector<ChainLink> read_links(const CommandInput& input, Provenance& provenance) {
  std::vector<ChainLink> links;
  const Study& study = input.study;
  if (study.has_static_moduli() || has_cases_of_pieces(study, CaseSection::Kind::static_test) ||
      study.substructures.slit_motions != fe_modal::SlitMotions::none)
    return links;
  Pieces pieces = read_pieces(input, provenance.inputs);
  for (const PieceSection& piece : study.substructures.pieces)
    links.push_back({piece.name, std::move(pieces.at(piece.name))});
  return links;
}

StaticTestSignals write(const CommandInput& input, const CaseSection& experiment,
                        const multibody::Model& model, multibody::History&& history,
                        const Provenance& provenance) {
  if (history.time_s.size() == 0)
    throw ComputationError(experiment.name + ": " + history.incomplete);
  StaticTestSignals signals = static_test_signals(model, history, experiment);
  multibody::HistoryFile file;
  file.history = std::move(history);
  file.channels = static_test_channels(signals);
  file.provenance = provenance;
  multibody::write_history(input.folder.history(experiment), file, [&] {
    write_csv(input.folder.curves(experiment), file.history.time_s,
              in_customary_units(file.channels, "in*lbf"));
  });
  for (const std::string& warning : file.history.warnings)
    input.console.warning(experiment.name + ": " + warning);
  require_whole_run(input.folder.history(experiment), file.history);
  return signals;
}

/// History of the run, or the part computed before it ended early.
template <class Run>
multibody::History history_of(const Run& run) {
  try {
    return run();
  } catch (const multibody::IncompleteRun& stopped) {
    return stopped.history;
  }
}

StaticEntry run_case(const CommandInput& input, const CaseSection& experiment,
                     const fe_modal::ModalBody& body, const std::vector<ChainLink>& links,
                     const Provenance& provenance) {
  input.console.step("Static neck tester: " + experiment.name);
  StaticEntry entry;
  entry.experiment = experiment;
  const multibody::Model model = case_model(experiment, body);
  entry.settled =
      static_test_signals(model, settled_static_test(input.study, experiment, model), experiment);
  entry.ramp =
      write(input, experiment, model, history_of([&] {
              return multibody::simulate(model, input.study.solver,
                                         {experiment.duration_s, input.study.output_interval_s});
            }),
            provenance);
  if (links.empty()) return entry;
  const multibody::Model chain = static_chain_model(experiment, links);
  CaseSection named = experiment;
  named.name += "-chain";
  entry.chain = write(
      input, named, chain,
      history_of([&] { return settled_static_test(input.study, experiment, chain); }), provenance);
  return entry;
}

}  // namespace

bool static_command(const CommandInput& input) {
  const bool has_own_moduli = input.study.has_static_moduli();
  const fs::path path = has_own_moduli ? input.folder.static_modes() : input.folder.modes();
  const fe_modal::ModalBodyFile modes = read_modal_body(path);
  require_same_inputs(path, modes.provenance, input.study, modes_provenance(input.study).parameters,
                      "flexneck modes");
  Provenance provenance = experiment_provenance(input.study, CaseSection::Kind::static_test);
  provenance.inputs.push_back({path.filename().string(), hash_of_file(path.string())});
  if (has_own_moduli && has_cases_of_pieces(input.study, CaseSection::Kind::static_test))
    throw InputError(input.study.file.string() +
                     ": sections from substructures in a static case do not support "
                     "static_modulus_ratio of [geometry.materials]; remove one of them");
  const std::vector<ChainLink> links = read_links(input, provenance);
  const Study study = with_pieces(input, provenance.inputs);
  std::vector<StaticEntry> entries;
  for (const CaseSection& experiment : study.cases)
    if (experiment.kind == CaseSection::Kind::static_test)
      entries.push_back(run_case(input, experiment, modes.body, links, provenance));
  std::vector<ResultTable> tables = {static_table(entries, has_own_moduli), ramp_table(entries)};
  if (!links.empty()) tables.push_back(chain_table(entries));
  write_tables(input.folder.file("static.json"), tables, provenance);
  show_tables(input, tables);
  return true;
}

}  // namespace flexneck::pipeline
