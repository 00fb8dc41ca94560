// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/process/command_program.h"

#include "geometry/foundation/error.h"
#include "geometry/foundation/running_object.h"

namespace flexneck::pipeline {

namespace fs = std::filesystem;

fs::path command_program() {
  if (runs_as_program()) return "/proc/self/exe";
  const fs::path module = running_object();
  for (fs::path at = module.parent_path();; at = at.parent_path()) {
    for (const char* const name : {"bin/flexneck", "flexneck"})
      if (fs::is_regular_file(at / name)) return at / name;
    if (at == at.root_path()) break;
  }
  throw ComputationError(
      module.string() +
      ": there is no command flexneck above it, which reads files of others in a "
      "process of its own; install flexneck again");
}

}  // namespace flexneck::pipeline
