// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/units.h"
#include "multibody/history_file.h"
#include "pipeline/commands/commands.h"
#include "pipeline/experiments/static_test.h"
#include "pipeline/output/csv_output.h"
#include "pipeline/output/customary_units.h"
#include "pipeline/output/result_table.h"

namespace flexneck::pipeline {

namespace {

std::vector<std::string> row_of(const std::string& name, const StaticTestResult& result) {
  const double deg = factor_from_si("rad", "deg");
  const double in_lbf = factor_from_si("N*m", "in*lbf");
  return {name,
          fmt::format("{:.3f}", result.rotation * deg),
          fmt::format("{:.3f}", result.deflection * factor_from_si("m", "in")),
          fmt::format("{:.1f}", result.base_moment * in_lbf),
          fmt::format("{:.2f}", result.initial_stiffness * in_lbf / deg),
          fmt::format("{:.2f}", result.final_stiffness * in_lbf / deg)};
}

StaticTestResult run_case(const CommandInput& input, const CaseSection& experiment,
                          const fe_modal::ModalBody& body, const Provenance& provenance) {
  input.console.step("Static neck tester: " + experiment.name);
  const multibody::Model model = static_test_model(input.study, experiment, body);
  multibody::HistoryFile file;
  file.history = multibody::simulate(model, input.study.solver,
                                     {experiment.duration_s, input.study.output_interval_s});
  const StaticTestSignals signals = static_test_signals(model, file.history, experiment);
  file.channels = static_test_channels(signals);
  file.provenance = provenance;
  multibody::write_history(input.folder.history(experiment), file);
  write_csv(input.folder.curves(experiment), file.history.time_s,
            in_customary_units(file.channels, "in*lbf"));
  return static_test_result(signals);
}

}  // namespace

bool static_command(const CommandInput& input) {
  const bool has_own_moduli = input.study.has_static_moduli();
  const std::filesystem::path path =
      has_own_moduli ? input.folder.static_modes() : input.folder.modes();
  const fe_modal::ModalBodyFile modes = fe_modal::read_modal_body(path);
  require_same_inputs(path, modes.provenance, input.study, "flexneck modes");
  Provenance provenance = provenance_of(input.study);
  provenance.inputs.push_back({path.filename().string(), hash_of_file(path.string())});

  ResultTable table;
  table.name = "static tests";
  table.title = "Static neck tester, at the end of the ramp" +
                std::string(has_own_moduli ? ", with the static moduli" : "");
  table.columns = {{"case", ""},
                   {"rotation", "deg"},
                   {"deflection", "in"},
                   {"base moment", "in*lbf"},
                   {"initial", "in*lbf/deg"},
                   {"final", "in*lbf/deg"}};
  for (const CaseSection& experiment : input.study.cases) {
    if (experiment.kind != CaseSection::Kind::static_test) continue;
    table.rows.push_back(
        row_of(experiment.name, run_case(input, experiment, modes.body, provenance)));
  }
  write_tables(input.folder.file("static.json"), {table}, provenance);
  input.console.result("\n" + printed(table));
  return true;
}

}  // namespace flexneck::pipeline
