// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/simulation/simulation.h"
#include "pipeline/model/model_file.h"
#include "tests/support/model_text.h"

namespace flexneck::testing {

inline pipeline::ModelFile read_model(const TemporaryFolder& folder, const std::string& text) {
  return pipeline::read_model_file(write_text(folder / "model.toml", text), {});
}

/// What reading and running this model refuses.
inline std::string refusal_of_model(const TemporaryFolder& folder, const std::string& text) {
  try {
    const pipeline::ModelFile file = read_model(folder, text);
    multibody::simulate(file.model, file.solver, {file.end_time_s, file.output.interval_s});
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

}  // namespace flexneck::testing
