// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace flexneck::multibody {

/// Form of the equations of motion that a run solves. The forms agree to rounding; see
/// integrators.md for the choice.
enum class Formulation {
  descriptor,  ///< all bodies' coordinates, joints as constraints with multipliers: any model
  recursive,   ///< joint coordinates: trees of bodies, work proportional to their number
  automatic    ///< recursive if the joints form trees, else descriptor
};

/// Time integration method of a run.
enum class Integrator {
  dormand_prince,    ///< explicit, order 5: for most models
  generalised_alpha  ///< implicit, order 2: for stiff models whose fast vibrations do not matter
};

struct SolverOptions {
  double relative_tolerance = 1e-6;
  double absolute_tolerance = 1e-9;
  double max_step_s = 0.05;
  double min_step_s = 1e-10;
  Formulation formulation = Formulation::automatic;
  int max_steps = 10'000'000;  ///< steps tried; a run that needs more is ended
  Integrator integrator = Integrator::dormand_prince;
  /// Spectral radius of the generalised-alpha method at infinite frequency, in [0, 1]: the factor
  /// by which a step multiplies vibrations that it does not resolve.
  double spectral_radius = 0.8;
  /// Features of a load given by a function are not stepped over if they are longer than this.
  double resolution_s = 1e-4;
  /// Called after each step, and after each output of a quasi-static ramp, so that a run can be
  /// stopped from outside: an exception that it throws ends the run, without a history unless it is
  /// a ComputationError.
  std::function<void()> checkpoint = {};
};

}  // namespace flexneck::multibody
