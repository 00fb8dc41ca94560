// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "geometry/foundation/error.h"
#include "geometry/foundation/temporary_folder.h"
#include "multibody/simulation/simulation.h"
#include "pipeline/language/model/model_file.h"
#include "tests/support/model_text.h"

namespace flexneck::testing {

inline pipeline::ModelFile read_model(const TemporaryFolder& folder, const std::string& text) {
  return pipeline::read_model_file(write_test_file(folder / "model.toml", text), {});
}

inline multibody::History run(const pipeline::ModelFile& file, bool states = false) {
  const multibody::OutputOptions output{
      .end_time_s = file.end_time_s, .interval_s = file.output.interval_s, .states = states};
  return file.start == pipeline::ModelFile::Start::equilibrium
             ? multibody::simulate_from_equilibrium(file.model, file.solver, output)
             : multibody::simulate(file.model, file.solver, output);
}

/// Message with which reading or running this model is refused.
inline std::string refusal_of_model(const TemporaryFolder& folder, const std::string& text) {
  try {
    const pipeline::ModelFile file = read_model(folder, text);
    run(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

}  // namespace flexneck::testing
