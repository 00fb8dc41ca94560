// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/experiments/pendulum.h"

#include <fmt/core.h>

#include "fe_modal/body/modal_body_file.h"
#include "geometry/foundation/units.h"
#include "multibody/history_file.h"
#include "pipeline/commands/commands.h"
#include "pipeline/text_table.h"

namespace flexneck::pipeline {

namespace {

/// "12.3 @ 45.6": a peak in the table's unit and its time in ms.
std::string text_of(const multibody::Peak& peak, double factor) {
  return fmt::format("{:.1f} @ {:.1f}", peak.value * factor, peak.time_s * 1e3);
}

std::string text_of(const std::optional<double>& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

multibody::History simulate_case(const CommandInput& input, const CaseSection& experiment,
                                 const fe_modal::ModalBody& body) {
  input.console.step("Head/neck pendulum: " + experiment.name);
  return multibody::simulate_from_equilibrium(
      pendulum_model(input.study, experiment, body), input.study.solver,
      {experiment.duration_s, input.study.output_interval_s});
}

}  // namespace

bool pendulum_command(const CommandInput& input) {
  const fe_modal::ModalBodyFile modes = fe_modal::read_modal_body(input.folder.modes());
  require_same_inputs(input.folder.modes(), modes.provenance, input.study, "flexneck modes");
  const double deg = factor_from_si("rad", "deg");
  const double lbf_ft = factor_from_si("N*m", "lbf*ft");
  const double gn = factor_from_si("m/s^2", "gn");
  std::vector<std::vector<std::string>> peaks = {
      {"peaks (@ ms)", "head deg", "neck deg", "c.g. gn", "j1 lbf*ft", "j2 lbf*ft"}};
  std::vector<std::vector<std::string>> oscillations = {
      {"small motions", "Hz", "zeta", "Hz without gravity", "zeta", "run Hz", "run zeta"}};
  for (const CaseSection& experiment : input.study.cases) {
    if (experiment.kind != CaseSection::Kind::pendulum) continue;
    multibody::HistoryFile file;
    file.history = simulate_case(input, experiment, modes.body);
    file.provenance = provenance_of(input.study);
    file.provenance.inputs.push_back(
        {input.folder.modes().filename().string(), hash_of_file(input.folder.modes().string())});
    multibody::write_history(input.folder.history(experiment), file);

    const PendulumResult result = pendulum_result(input.study, experiment, file.history);
    peaks.push_back({experiment.name, text_of(result.head_rotation, deg),
                     text_of(result.neck_rotation, deg), text_of(result.head_acceleration, gn),
                     text_of(result.base_moment, lbf_ft),
                     text_of(result.occipital_moment, lbf_ft)});
    const auto hanging = first_system_mode(input.study, experiment, modes.body, true);
    const auto weightless = first_system_mode(input.study, experiment, modes.body, false);
    oscillations.push_back({experiment.name, fmt::format("{:.3f}", hanging.frequency_Hz),
                            fmt::format("{:.4f}", hanging.damping_ratio),
                            fmt::format("{:.3f}", weightless.frequency_Hz),
                            fmt::format("{:.4f}", weightless.damping_ratio),
                            text_of(result.run_frequency_Hz, "{:.3f}"),
                            text_of(result.run_damping_ratio, "{:.4f}")});
  }
  input.console.result("\nHead/neck pendulum (pulse: synthetic)\n" + text_table(peaks) + "\n\n" +
                       text_table(oscillations));
  return true;
}

}  // namespace flexneck::pipeline
