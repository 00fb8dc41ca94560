// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "multibody/equations/solver_options.h"
#include "pipeline/language/document/study_document.h"

namespace flexneck::pipeline {

inline std::vector<std::string> formulations() { return {"descriptor", "recursive", "automatic"}; }
inline std::vector<std::string> integrators() { return {"dormand_prince", "generalised_alpha"}; }

inline constexpr auto kStepKeys = std::to_array<Key>({
    Key::number("relative_tolerance", "1e-6", "Relative tolerance of a step", {.range = kPositive}),
    Key::number("absolute_tolerance", "1e-9", "Absolute tolerance of a step", {.range = kPositive}),
    Key::quantity("max_step", "s", "0.05", "Largest time step"),
    Key::quantity("min_step", "s", "1e-10",
                  "Smallest time step; a run that needs a smaller one fails", {.range = kPositive}),
    Key::text("formulation", "automatic",
              "Formulation of the equations of motion: descriptor (all bodies with constraints), "
              "recursive (joint coordinates), or chosen automatically",
              {.choices = formulations}),
    Key::text("integrator", "dormand_prince", "Time integration method", {.choices = integrators}),
    Key::number("spectral_radius", "0.8",
                "Spectral radius at infinite frequency of generalised_alpha: amplitude factor per "
                "step of vibrations that the step does not resolve",
                {.range = {.low = 0, .high = 1}}),
    Key::quantity("resolution", "s", "0.0001",
                  "Resolution of motions and loads given by expressions: features shorter than "
                  "this may be missed",
                  {.range = kPositive}),
    Key::count("max_steps", "10000000", "Maximum number of time steps; a run that needs more fails",
               {.range = at_least(1)}),
});

/// Reads the settings of time integration, the keys kStepKeys.
void read_steps(const StudyTable& solver, multibody::SolverOptions& options);

}  // namespace flexneck::pipeline
