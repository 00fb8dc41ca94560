// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/commands/commands.h"

namespace flexneck::pipeline {

const std::vector<Command>& commands() {
  static const std::vector<Command> list = {
      {"run", "everything below in order (the default)", run_command},
      {"mesh", "mesh the geometry: mesh.h5", mesh_command},
      {"modes", "modes of the mesh: modes.h5", modes_command},
      {"static", "static neck tester: static-<case>.h5", static_command},
      {"pendulum", "head/neck pendulum: pendulum-<case>.h5", pendulum_command},
      {"verify", "compare with published figures: verification.json", verify_command},
      {"study", "print every input with its origin", study_command},
  };
  return list;
}

bool run_command(const CommandInput& input) {
  mesh_command(input);
  modes_command(input);
  static_command(input);
  pendulum_command(input);
  return verify_command(input);
}

}  // namespace flexneck::pipeline
