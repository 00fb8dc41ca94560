// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

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
  double max_step_s = 0.05;
  double min_step_s = 1e-10;
  Formulation formulation = Formulation::automatic;
  int max_steps = 10'000'000;  ///< tried; a run that needs more is given up
  Integrator integrator = Integrator::dormand_prince;
  /// Of the generalised-alpha method, in [0, 1]: by what a step multiplies vibrations that it does
  /// not resolve.
  double spectral_radius = 0.8;
  /// No feature of a load given by a function that is longer than this is stepped over.
  double resolution_s = 1e-4;
  /// Called after each step, and after each output of a quasi-static ramp: what it throws ends the
  /// run, without a history unless it is a ComputationError. So a run is stopped from outside.
  std::function<void()> checkpoint = {};
};

}  // namespace flexneck::multibody
