// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/equations/solver_options.h"
#include "multibody/history/history.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/history/output_options.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Runs a model from the state its bodies are given at its start; constraints are projected first.
/// Joints that repeat what others hold are treated: see History::redundant_constraints.
/// @throws InputError if the model is not sound, an option makes no sense, a joint is violated at
/// the start in position or velocity by more than rounding (1e-6 of the system's size or speed,
/// 1e-6 rad), or if the recursive formulation is asked for and a joint closes a loop.
/// @throws IncompleteRun if the step collapses or the steps are used up: time and what limited it.
History simulate(const Model& model, const SolverOptions& solver, const OutputOptions& output);

/// Runs a model from the static equilibrium of its free bodies relative to the prescribed ones
/// under gravity and the forces at time zero, all moving with the prescribed bodies' initial
/// velocity.
/// @throws InputError besides if a body hangs on no prescribed body, or if one turns at time zero.
/// @throws ComputationError besides if no equilibrium is found.
History simulate_from_equilibrium(const Model& model, const SolverOptions& solver,
                                  const OutputOptions& output);

/// A quasi-static ramp: the static equilibria at the output times, each sought from the one before,
/// the first from the poses that the bodies are given. Forces have their values at that time, and
/// prescribed bodies are at rest where they are then. What needs motion does nothing: inertia,
/// dampers, friction, hysteresis; velocities and accelerations are zero but for rounding.
/// @throws InputError as simulate() but for velocities.
/// @throws IncompleteRun if no equilibrium is found at some time, as where a column buckles.
History settle(const Model& model, const SolverOptions& solver, const OutputOptions& output);

}  // namespace flexneck::multibody
