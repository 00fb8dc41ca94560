// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/language/model/solver_steps.h"

namespace flexneck::pipeline {

void read_steps(const StudyTable& table, multibody::SolverOptions& options) {
  options.relative_tolerance = table.number("relative_tolerance");
  options.absolute_tolerance = table.number("absolute_tolerance");
  options.max_step_s = table.quantity("max_step");
  options.min_step_s = table.quantity("min_step");
  options.max_steps = table.count("max_steps");
  options.formulation = static_cast<multibody::Formulation>(table.choice("formulation"));
  options.integrator = static_cast<multibody::Integrator>(table.choice("integrator"));
  options.resolution_s = table.quantity("resolution");
  if (options.integrator != multibody::Integrator::generalised_alpha)
    table.refuse_given({"spectral_radius"},
                       "has no effect without integrator = \"generalised_alpha\"; remove this key");
  options.spectral_radius = table.number("spectral_radius");
  if (!(options.max_step_s > options.min_step_s)) {
    table.refuse("max_step", "expected 0 < min_step < max_step");
  }
}

}  // namespace flexneck::pipeline
