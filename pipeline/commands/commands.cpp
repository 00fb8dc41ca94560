// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/commands/commands.h"

namespace flexneck::pipeline {

void warn_of_replaced(const CommandInput& input, const std::filesystem::path& file,
                      const FileFormat& format, const Provenance& now) {
  if (input.is_run) return;  // which makes anew what follows
  const std::string warning = replaced_values(file, format, now);
  if (!warning.empty()) input.console.warning(warning);
}

const std::vector<Command>& commands() {
  using enum CommandOption;
  const FileArguments study = {"STUDY.toml", "Default: the built-in Hybrid III study"};
  const FileArguments same_study = {"STUDY.toml",
                                    "Default: the study that the folder was made with"};
  static const std::vector<Command> list = {
      {.name = "run",
       .help = "mesh, modes, pictures, static, pendulum, verify and report (the default)",
       .files = study,
       .options = {folder, settings, mesh_settings, modes_settings, redo},
       .run = run_command,
       .begins = true},
      {.name = "mesh",
       .help = "mesh the geometry: mesh.h5",
       .files = study,
       .options = {folder, settings, mesh_settings, show},
       .run = mesh_command,
       .begins = true},
      {.name = "modes",
       .help = "modes of the mesh: modes.h5",
       .files = same_study,
       .options = {folder, settings, modes_settings},
       .run = modes_command},
      {.name = "pictures",
       .help = "draw mesh and modes: mesh.png, modes.png",
       .files = same_study,
       .options = {folder, settings},
       .run = pictures_command},
      {.name = "static",
       .help = "static neck tester: static-<case>.h5",
       .files = same_study,
       .options = {folder, settings},
       .run = static_command},
      {.name = "pendulum",
       .help = "head/neck pendulum: pendulum-<case>.h5",
       .files = same_study,
       .options = {folder, settings},
       .run = pendulum_command},
      {.name = "verify",
       .help = "compare with published figures, judge tests: verification.json, verdicts.json",
       .files = same_study,
       .options = {folder, settings},
       .run = verify_command},
      {.name = "export",
       .help =
           "mesh for gmsh or CalculiX, K and M, modes for the ATB: .msh, .inp, .mtx, .petsc, .dat",
       .files = same_study,
       .options = {folder, settings, target},
       .run = export_command,
       .writes_results = false},
      {.name = "report",
       .help = "all results on one page: report.html",
       .files = same_study,
       .options = {folder, settings},
       .run = report_command},
      {.name = "simulate",
       .help = "run a model file: <model>.h5 and <model>.csv",
       .files = {"MODEL.toml", "The model"},
       .options = {folder, settings},
       .run = nullptr,
       .run_on_files = simulate_command},
      {.name = "info",
       .help = "describe files that flexneck has written: what is in them, what made them",
       .files = {"FILE ...", "The files"},
       .options = {},
       .run = nullptr,
       .run_on_files = info_command,
       .writes_results = false},
      {.name = "compare",
       .help = "folders of results side by side: comparison.html",
       .files = {"FOLDER ...", "The folders, at least two"},
       .options = {folder},
       .run = nullptr,
       .run_on_files = compare_command},
      {.name = "study",
       .help = "print every input with its origin",
       .files = same_study,
       .options = {folder, settings, mesh_settings, modes_settings},
       .run = study_command,
       .writes_results = false},
      {.name = "keys",
       .help = "tell the keys that studies and models may have, with units and defaults",
       .files = {"TABLE ...", "Such as study, study.case or model.joint.axis; default: all tables"},
       .options = {},
       .run = nullptr,
       .run_on_files = keys_command,
       .writes_results = false},
  };
  return list;
}

}  // namespace flexneck::pipeline
