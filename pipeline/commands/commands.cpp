// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/commands/commands.h"

#include <algorithm>

#include "pipeline/text_table.h"

namespace flexneck::pipeline {

const std::vector<Command>& commands() {
  static const std::vector<Command> list = {
      {"run", "everything below in order (the default)", run_command},
      {"mesh", "mesh the geometry: mesh.h5", mesh_command},
      {"modes", "modes of the mesh: modes.h5", modes_command},
      {"pictures", "draw mesh and modes: mesh.png, modes.png", pictures_command},
      {"static", "static neck tester: static-<case>.h5", static_command},
      {"pendulum", "head/neck pendulum: pendulum-<case>.h5", pendulum_command},
      {"verify", "compare with published figures: verification.json", verify_command},
      {"export",
       "write the mesh for gmsh or CalculiX, its K and M, or its modes for the ATB: --to FILE.msh, "
       ".inp, .mtx, .petsc, .dat",
       export_command},
      {"report", "all results on one page: report.html", report_command},
      {"simulate", "run a model file: <model>.h5 and <model>.csv", nullptr},
      {"study", "print every input with its origin", study_command},
  };
  return list;
}

namespace {

/// "published 12, inferred 5, …"
std::string origin_counts(const Study& study) {
  std::string text;
  for (std::size_t i = 0; i < kOriginNames.size(); ++i) {
    const auto count = std::count_if(
        study.parameters.begin(), study.parameters.end(),
        [&](const Parameter& parameter) { return parameter.origin == static_cast<Origin>(i); });
    text += (i > 0 ? ", " : "") + std::string(kOriginNames[i]) + " " + std::to_string(count);
  }
  return text;
}

/// The dimensions of the neck and the figures of its bodies, each with its origin.
std::string origin_table(const Study& study) {
  std::vector<std::vector<std::string>> rows = {{"input", "value", "origin"}};
  for (const Parameter& parameter : study.parameters) {
    if (parameter.origin == Origin::synthetic) continue;
    rows.push_back({parameter.key, parameter.value, std::string(name_of(parameter.origin))});
  }
  return text_table(rows, {0, 1, 2});
}

}  // namespace

bool run_command(const CommandInput& input) {
  if (input.study.matrices) return modes_command(input);
  if (input.study.structure) {  // the experiments below are the neck's
    return mesh_command(input) && modes_command(input) && pictures_command(input);
  }
  input.console.result("Inputs by origin: " + origin_counts(input.study) +
                       "; 'flexneck study' lists them with their sources.\n" +
                       origin_table(input.study));
  mesh_command(input);
  modes_command(input);
  pictures_command(input);
  static_command(input);
  pendulum_command(input);
  const bool passed = verify_command(input);
  return report_command(input) && passed;
}

}  // namespace flexneck::pipeline
