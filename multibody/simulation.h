// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "geometry/foundation/error.h"
#include "multibody/history.h"
#include "multibody/model.h"

namespace flexneck::multibody {

/// Which equations of motion a run solves. They agree to rounding; see README.md for the choice.
enum class Formulation {
  descriptor,  ///< all bodies' coordinates, joints as constraints with multipliers: any model
  recursive,   ///< joint coordinates: trees of bodies, work in proportion to their number
  automatic    ///< recursive where the joints make trees, else descriptor
};

/// How a run steps through time.
enum class Integrator {
  dormand_prince,    ///< explicit, order 5: for most models
  generalised_alpha  ///< implicit, order 2: for stiff ones, whose fast vibrations do not matter
};

struct SolverOptions {
  double relative_tolerance = 1e-6;
  double absolute_tolerance = 1e-9;
  double largest_step_s = 0.05;
  double smallest_step_s = 1e-10;
  Formulation formulation = Formulation::automatic;
  int most_steps = 10'000'000;  ///< tried; a run that needs more is given up
  Integrator integrator = Integrator::dormand_prince;
  /// Of the generalised-alpha method, in [0, 1]: by what a step multiplies vibrations that it does
  /// not resolve.
  double spectral_radius = 0.8;
};

/// A run that could not go on: when and why, and what was computed until then.
class IncompleteRun : public ComputationError {
 public:
  IncompleteRun(const std::string& why, History computed)
      : ComputationError(why), history(std::move(computed)) {}
  History history;  ///< with `incomplete` set
};

struct OutputOptions {
  double end_time_s = 1.0;
  double interval_s = 1e-3;
  /// Where there is one, it takes the outputs in blocks as they come, so that memory does not grow
  /// with their number. What the run returns then has the last block only.
  std::function<void(const History& outputs)> sink = {};
  Eigen::Index block = 0;  ///< outputs of a block, with a sink
};

/// One mode of the linearised system.
struct SystemMode {
  double frequency_Hz = 0;  ///< |lambda| / 2 pi, the undamped frequency
  double damped_frequency_Hz = 0;
  double damping_ratio = 0;
  double growth_rate_1_s = 0;  ///< of an unstable one: its largest Re lambda; of others zero

  bool is_unstable() const { return growth_rate_1_s > 0; }
};

/// Runs a model from the state its bodies are given; constraints are projected first. Joints that
/// repeat what others hold are treated: see History::redundant_constraints.
/// @throws InputError if the model is not sound, an option makes no sense, a joint is violated at
/// the start in position or velocity by more than rounding (1e-6 of the system's size or speed,
/// 1e-6 rad), or if the recursive formulation is asked for and a joint closes a loop.
/// @throws IncompleteRun if the step collapses or the steps are used up: time and what limited it.
History simulate(const Model& model, const SolverOptions& solver, const OutputOptions& output);

/// Runs a model from the static equilibrium of its free bodies relative to the driven ones under
/// gravity and the forces at time zero, all moving with the driven bodies' initial velocity.
/// @throws InputError besides if a body hangs on no driven body, or if one turns at time zero.
/// @throws ComputationError besides if no equilibrium is found.
History simulate_from_equilibrium(const Model& model, const SolverOptions& solver,
                                  const OutputOptions& output);

/// A quasi-static ramp: the static equilibria at the output times, each sought from the one before,
/// the first from the poses that the bodies are given. Forces have their values at that time, and
/// driven bodies are at rest where they are then. What needs motion does nothing: inertia, dampers,
/// friction, hysteresis; velocities and accelerations are zero but for rounding.
/// @throws InputError as simulate() but for velocities.
/// @throws IncompleteRun if no equilibrium is found at some time, as where a column buckles.
History settle(const Model& model, const SolverOptions& solver, const OutputOptions& output);

/// Small motions about that equilibrium, or about steady rotation where driven bodies turn (see
/// LinearisedAt), ascending in frequency. An overdamped mode has a damping ratio of one or more and
/// the damped frequency zero; a motion without restoring force has frequency zero. One that grows
/// is unstable: with a frequency it swings, with frequency zero it moves away.
/// @throws as linearise().
std::vector<SystemMode> system_modes(const Model& model);

}  // namespace flexneck::multibody
