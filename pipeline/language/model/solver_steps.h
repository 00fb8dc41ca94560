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
    Key::quantity("max_step", "s", "0.05", "Largest step"),
    Key::quantity("min_step", "s", "1e-10", "Smallest step, below which a run ends",
                  {.range = kPositive}),
    Key::text("formulation", "automatic",
              "Equations of motion: of all bodies with constraints, of joint coordinates, or "
              "whichever "
              "fits",
              {.choices = formulations}),
    Key::text("integrator", "dormand_prince", "How a run steps through time",
              {.choices = integrators}),
    Key::number(
        "spectral_radius", "0.8",
        "Of generalised_alpha: by what a step multiplies vibrations that it does not resolve",
        {.range = {.low = 0, .high = 1}}),
    Key::quantity("resolution", "s", "0.0001",
                  "No feature of a motion or a load by an expression that is longer is missed",
                  {.range = kPositive}),
    Key::count("max_steps", "10000000", "Steps after which a run is given up",
               {.range = at_least(1)}),
});

/// Reads the settings of time integration, the keys kStepKeys.
void read_steps(const StudyTable& solver, multibody::SolverOptions& options);

}  // namespace flexneck::pipeline
