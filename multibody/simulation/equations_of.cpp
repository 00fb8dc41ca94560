// SPDX-License-Identifier: GPL-3.0-or-later
#include "multibody/simulation/equations_of.h"

#include <cmath>
#include <string>

#include "geometry/foundation/error.h"
#include "geometry/foundation/output_file.h"
#include "multibody/descriptor/massless_rotation.h"
#include "multibody/model/prescribed_path.h"
#include "multibody/tree/tree.h"

namespace flexneck::multibody {
namespace {

void check_positive(double value, const std::string& what) {
  if (!(value > 0 && std::isfinite(value)))
    throw InputError(what + " must be positive, not " + exact_text(value));
}

void check_options(const SolverOptions& solver) {
  check_positive(solver.relative_tolerance, "the relative tolerance");
  check_positive(solver.absolute_tolerance, "the absolute tolerance");
  check_positive(solver.min_step_s, "the smallest step");
  check_positive(solver.max_step_s, "the largest step");
  if (solver.max_step_s < solver.min_step_s)
    throw InputError("the largest step must not be below the smallest step");
  if (!(solver.spectral_radius >= 0 && solver.spectral_radius <= 1))
    throw InputError("the spectral radius must be from 0 to 1, not " +
                     rounded_text(solver.spectral_radius));
  if (solver.max_steps < 1) throw InputError("the maximum number of steps must be positive");
}

}  // namespace

void check_start(const Model& model, const SolverOptions& solver) {
  check(model);
  check_massless_rotations(model);
  check_options(solver);
}

std::unique_ptr<Equations> equations_of(const Model& model, const SolverOptions& solver,
                                        Drive drive) {
  const bool recursive = solver.formulation == Formulation::recursive ||
                         (solver.formulation == Formulation::automatic && tree::is_tree(model));
  return recursive ? recursive_equations(model, solver, drive)
                   : descriptor_equations(model, solver, drive);
}

void check_nothing_turns(const Model& model) {
  for (const Body& body : model.bodies) {
    const auto* prescribed = std::get_if<PrescribedBody>(&body.kind);
    if (prescribed == nullptr) continue;
    const PrescribedMotion motion = PrescribedPath(body.initial_pose, *prescribed).at(0);
    if (motion.angular_velocity_rad_s.isZero(0)) continue;
    throw InputError("body '" + body.name +
                     "' rotates at time zero; a start from equilibrium needs prescribed bodies "
                     "that do not rotate at that time");
  }
}

}  // namespace flexneck::multibody
