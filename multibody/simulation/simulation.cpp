// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/simulation/simulation.h"

#include <cmath>
#include <memory>
#include <string>

#include "geometry/foundation/available_memory.h"
#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "multibody/descriptor/massless_rotation.h"
#include "multibody/equations/equations.h"
#include "multibody/history/recorder.h"
#include "multibody/model/prescribed_path.h"
#include "multibody/time/motion.h"
#include "multibody/tree/tree.h"

namespace flexneck::multibody {
namespace {

void check_positive(double value, const std::string& what) {
  if (!(value > 0 && std::isfinite(value)))
    throw InputError(what + " must be positive, not " + exact_text(value));
}

void check_options(const SolverOptions& solver, const OutputOptions& output) {
  check_positive(solver.relative_tolerance, "the relative tolerance");
  check_positive(solver.absolute_tolerance, "the absolute tolerance");
  check_positive(solver.min_step_s, "the smallest step");
  check_positive(solver.max_step_s, "the largest step");
  if (solver.max_step_s < solver.min_step_s)
    throw InputError("the largest step must not be below the smallest");
  if (!(solver.spectral_radius >= 0 && solver.spectral_radius <= 1))
    throw InputError("the spectral radius must be from 0 to 1, not " +
                     std::to_string(solver.spectral_radius));
  if (solver.max_steps < 1) throw InputError("the largest number of steps must be positive");
  check_positive(output.end_time_s, "the end time");
  check_positive(output.interval_s, "the output interval");
  if (output.end_time_s / output.interval_s > 1e8)
    throw InputError("the output interval gives over 1e8 output times; make it longer");
}

/// A history as a whole, and what is derived from it. Few outputs always fit.
void check_memory(const Model& model, const OutputOptions& output) {
  constexpr Eigen::Index kFew = 100'000;
  constexpr double kCopies = 2.5;
  const Eigen::Index count = OutputTimes(output).count();
  if (output.sink || count <= kFew) return;
  require_memory("the history of " + std::to_string(count) + " outputs",
                 kCopies * sizeof(double) * static_cast<double>(count) *
                     static_cast<double>(numbers_per_output(model)),
                 "make the output interval longer");
}

void check_start(const Model& model) {
  check(model);
  check_massless_rotations(model);
}

std::unique_ptr<Equations> equations_of(const Model& model, const SolverOptions& solver,
                                        Drive drive = Drive::prescribed) {
  const bool recursive = solver.formulation == Formulation::recursive ||
                         (solver.formulation == Formulation::automatic && tree::is_tree(model));
  return recursive ? recursive_equations(model, solver, drive)
                   : descriptor_equations(model, solver, drive);
}

/// Bodies on one that turns would be pulled outwards: they have no static equilibrium.
void check_nothing_turns(const Model& model) {
  for (const Body& body : model.bodies) {
    const auto* prescribed = std::get_if<PrescribedBody>(&body.kind);
    if (prescribed == nullptr) continue;
    const PrescribedMotion motion = PrescribedPath(body.initial_pose, *prescribed).at(0);
    if (motion.angular_velocity_rad_s.isZero(0)) continue;
    throw InputError(
        "body '" + body.name +
        "' turns at time zero; a start from equilibrium needs prescribed bodies that do "
        "not turn then");
  }
}

}  // namespace

History simulate(const Model& model, const SolverOptions& solver, const OutputOptions& output) {
  check_start(model);
  check_options(solver, output);
  check_memory(model, output);
  const std::unique_ptr<Equations> equations = equations_of(model, solver);
  return integrate(model, *equations, equations->given_state(), solver, output);
}

History simulate_from_equilibrium(const Model& model, const SolverOptions& solver,
                                  const OutputOptions& output) {
  check_start(model);
  check_options(solver, output);
  check_memory(model, output);
  check_nothing_turns(model);
  const std::unique_ptr<Equations> equations = equations_of(model, solver);
  return integrate(model, *equations, equations->equilibrium_state(), solver, output);
}

History settle(const Model& model, const SolverOptions& solver, const OutputOptions& output) {
  check_start(model);
  check_options(solver, output);
  check_memory(model, output);
  const std::unique_ptr<Equations> equations = equations_of(model, solver, Drive::held);
  return settle_along(model, *equations, solver.checkpoint, output);
}

}  // namespace flexneck::multibody
