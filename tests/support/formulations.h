// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include "multibody/simulation/simulation.h"

namespace flexneck::testing {

/// Runs the calling test case once with each formulation.
inline multibody::Formulation either_formulation() {
  return GENERATE(multibody::Formulation::descriptor, multibody::Formulation::recursive);
}

inline multibody::SolverOptions solver_of(double relative, double absolute) {
  return {.relative_tolerance = relative,
          .absolute_tolerance = absolute,
          .formulation = either_formulation()};
}

/// Options for runs that are compared with closed forms.
inline multibody::SolverOptions tight_solver() { return solver_of(1e-11, 1e-13); }

}  // namespace flexneck::testing
