// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/simulation/simulation.h"

#include <cmath>
#include <string>
#include <utility>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "multibody/history/recorder.h"
#include "multibody/simulation/equations_of.h"
#include "multibody/time/motion.h"

namespace flexneck::multibody {
namespace {

void check_outputs(const OutputOptions& output) {
  for (const auto& [value, what] : {std::pair{output.end_time_s, "the end time"},
                                    std::pair{output.interval_s, "the output interval"}})
    if (!(value > 0 && std::isfinite(value)))
      throw InputError(std::string(what) + " must be positive, not " + exact_text(value));
  if (!(output.begin_time_s < output.end_time_s))
    throw InputError("the end time must be after the start time, " +
                     exact_text(output.begin_time_s) + " s");
  if ((output.end_time_s - output.begin_time_s) / output.interval_s > 1e8)
    throw InputError("the output interval gives over 1e8 output times; increase it");
}

/// Checks that a whole history, with the data derived from it, fits into memory. Few outputs always
/// fit.
void check_memory(const Model& model, const OutputOptions& output) {
  constexpr Eigen::Index kFew = 100'000;
  constexpr double kCopies = 2.5;
  const Eigen::Index count = OutputTimes(output).count();
  if (output.sink || count <= kFew) return;
  require_memory("the history of " + std::to_string(count) + " outputs",
                 kCopies * sizeof(double) * static_cast<double>(count) *
                     static_cast<double>(numbers_per_output(model)),
                 "increase the output interval");
}

}  // namespace

History simulate(const Model& model, const SolverOptions& solver, const OutputOptions& output) {
  check_start(model, solver);
  OutputOptions outputs = output;
  outputs.begin_time_s = model.start.time_s;
  check_outputs(outputs);
  check_memory(model, outputs);
  const std::unique_ptr<Equations> equations = equations_of(model, solver);
  return integrate(model, *equations, equations->given_state(), solver, outputs);
}

History simulate_from_equilibrium(const Model& model, const SolverOptions& solver,
                                  const OutputOptions& output) {
  check_start(model, solver);
  check_outputs(output);
  check_memory(model, output);
  check_nothing_turns(model);
  const std::unique_ptr<Equations> equations = equations_of(model, solver);
  return integrate(model, *equations, equations->equilibrium_state(), solver, output);
}

History settle(const Model& model, const SolverOptions& solver, const OutputOptions& output) {
  for (const Section& section : model.forces.of<Section>())
    if (section.has_friction())
      throw InputError(title(section) +
                       ": a quasi-static run cannot have friction in slits, which depends on the "
                       "path of the motion; use a slow dynamic run, or no friction");
  check_start(model, solver);
  check_outputs(output);
  check_memory(model, output);
  const std::unique_ptr<Equations> equations = equations_of(model, solver, Drive::held);
  return settle_along(model, *equations, solver.checkpoint, output);
}

}  // namespace flexneck::multibody
