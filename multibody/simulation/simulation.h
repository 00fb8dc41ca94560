// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "multibody/equations/solver_options.h"
#include "multibody/history/history.h"
#include "multibody/history/incomplete_run.h"
#include "multibody/history/output_options.h"
#include "multibody/model/model.h"

namespace flexneck::multibody {

/// Runs a model from its bodies' initial state; constraints are projected first. Redundant joints
/// are permitted: see History::redundant_constraints.
/// @throws InputError if the model is not sound, an option makes no sense, a joint is violated at
/// the start in position or velocity by more than rounding (1e-6 of the system's size or speed,
/// 1e-6 rad), or if the recursive formulation is asked for and a joint closes a loop.
/// @throws IncompleteRun if the step collapses or the steps are used up, with the time and the
/// limiting component.
History simulate(const Model& model, const SolverOptions& solver, const OutputOptions& output);

/// Runs a model from the static equilibrium of its free bodies relative to the prescribed ones
/// under gravity and the forces at time zero, all moving with the prescribed bodies' initial
/// velocity.
/// @throws InputError as simulate(), and if a body is connected to no prescribed body, or if one
/// rotates at time zero.
/// @throws ComputationError as simulate(), and if no equilibrium is found.
History simulate_from_equilibrium(const Model& model, const SolverOptions& solver,
                                  const OutputOptions& output);

/// A quasi-static ramp: the static equilibria at the output times, each sought from the one before,
/// the first from the bodies' initial poses. Forces have their values at that time, and prescribed
/// bodies are at rest at their positions then. Effects of motion are absent: inertia, dampers,
/// friction, hysteresis; velocities and accelerations are zero except for rounding.
/// @throws InputError as simulate() but for velocities.
/// @throws IncompleteRun if no equilibrium is found at some time, as where a column buckles.
History settle(const Model& model, const SolverOptions& solver, const OutputOptions& output);

}  // namespace flexneck::multibody
