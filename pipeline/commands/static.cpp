// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/core.h>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/units.h"
#include "multibody/history_file.h"
#include "pipeline/commands/commands.h"
#include "pipeline/experiments/static_test.h"
#include "pipeline/text_table.h"

namespace flexneck::pipeline {

bool static_command(const CommandInput& input) {
  const bool has_own_moduli = input.study.has_static_moduli();
  const std::filesystem::path path =
      has_own_moduli ? input.folder.static_modes() : input.folder.modes();
  const fe_modal::ModalBodyFile modes = fe_modal::read_modal_body(path);
  require_same_inputs(path, modes.provenance, input.study, "flexneck modes");
  const double deg = factor_from_si("rad", "deg");
  const double in_lbf = factor_from_si("N*m", "in*lbf");
  std::vector<std::vector<std::string>> rows = {{"case", "rotation deg", "deflection in",
                                                 "base moment in*lbf", "initial in*lbf/deg",
                                                 "final in*lbf/deg"}};
  for (const CaseSection& experiment : input.study.cases) {
    if (experiment.kind != CaseSection::Kind::static_test) continue;
    input.console.step("Static neck tester: " + experiment.name);
    multibody::HistoryFile file;
    file.history = multibody::simulate(static_test_model(input.study, experiment, modes.body),
                                       input.study.solver,
                                       {experiment.duration_s, input.study.output_interval_s});
    file.provenance = provenance_of(input.study);
    file.provenance.inputs.push_back({path.filename().string(), hash_of_file(path.string())});
    multibody::write_history(input.folder.history(experiment), file);

    const StaticTestResult result = static_test_result(file.history, experiment);
    rows.push_back({experiment.name, fmt::format("{:.3f}", result.rotation * deg),
                    fmt::format("{:.3f}", result.deflection * factor_from_si("m", "in")),
                    fmt::format("{:.1f}", result.base_moment * in_lbf),
                    fmt::format("{:.2f}", result.initial_stiffness * in_lbf / deg),
                    fmt::format("{:.2f}", result.final_stiffness * in_lbf / deg)});
  }
  input.console.result("\nStatic neck tester, at the end of the ramp" +
                       std::string(has_own_moduli ? ", with the static moduli" : "") + "\n" +
                       text_table(rows));
  return true;
}

}  // namespace flexneck::pipeline
