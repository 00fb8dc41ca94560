// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/cli/sensitivity.h"

#include <utility>

#include <fmt/core.h>

#include "fe_modal/analysis/sensitivity.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/step_times.h"
#include "pipeline/cli/design_parameters.h"
#include "pipeline/results/tables/sensitivity_tables.h"

namespace flexneck::pipeline {

namespace {

/// Prints the parameters left out, those that might have had a derivative as warnings.
void show_left_out(const Console& console, const std::vector<LeftOutParameter>& left_out) {
  for (const LeftOutParameter& each : left_out) {
    const std::string line = each.key + " is left out: " + each.why;
    each.is_choice ? console.result(line) : console.warning("--sensitivity: " + line);
  }
}

}  // namespace

void check_sensitivity(const Study& study) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(study.file.string() + ": --sensitivity " + problem);
  };
  if (study.matrices) {
    refuse("needs a mesh, [matrices] has no elements to differentiate; take it away");
  }
  if (study.modes.prestress) {
    refuse("is not offered of prestressed modes; leave modes.prestress out");
  }
  if (study.modes.basis == fe_modal::BasisKind::craig_bampton) {
    refuse(
        "needs eigenvectors, found modes.basis = \"craig-bampton\"; take \"normal\" or "
        "\"residual\"");
  }
}

void write_sensitivities(const CommandInput& input, const mesher::Mesh& mesh,
                         const fe_modal::ModalOptions& options, const fe_modal::ModalBody& body,
                         const fe_modal::AnalysisFields& fields, Provenance provenance) {
  StepTimes times;
  input.console.step("Moving the mesh a little with each dimension");
  times.start("runs of the script");
  StudyParameters study = design_parameters(input.study, mesh, input.console);
  times.start("sensitivities");
  input.console.step(fmt::format("Differentiating by {} inputs", study.parameters.size()));
  const fe_modal::Sensitivities found =
      fe_modal::sensitivities(mesh, options, body, fields, std::move(study.parameters));
  times.stop();
  input.console.detail()(
      fmt::format("seconds: {}; {} runs of the script", times.summary(), study.script_runs));
  std::vector<std::string> notes;
  for (const LeftOutParameter& each : study.left_out)
    notes.push_back("Left out is " + each.key + ": " + each.why + ".");
  const std::vector<ResultTable> tables = sensitivity_tables(found, notes);
  const std::filesystem::path path = input.folder.sensitivities();
  provenance.inputs.push_back(
      {input.folder.modes().filename().string(), hash_of_file(input.folder.modes().string())});
  write_tables(path, tables, provenance);
  if (input.console.is_verbose()) {
    for (const ResultTable& table : tables)
      if (table.name != kSensitivityTable) input.console.table("\n" + printed(table));
  } else {
    input.console.result("\n" + short_sensitivities(found));
  }
  show_left_out(input.console, study.left_out);
  input.console.result("All sensitivities: " + path.string());
}

}  // namespace flexneck::pipeline
