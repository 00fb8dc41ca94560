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
       export_command, nullptr, false},
      {"report", "all results on one page: report.html", report_command},
      {"simulate", "run a model file: <model>.h5 and <model>.csv", nullptr, simulate_command},
      {"info", "describe files that flexneck has written: what is in them, what made them", nullptr,
       info_command, false},
      {"compare", "folders of results side by side: comparison.html", nullptr, compare_command},
      {"study", "print every input with its origin", study_command, nullptr, false},
  };
  return list;
}

}  // namespace flexneck::pipeline
